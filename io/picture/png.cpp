#include <string>

#include <fmt/format.h>
#include <png.h>

#include "io/errors.h"
#include "io/output_file.h"
#include "io/picture/picture.h"
#include "solver/core/check.h"

namespace supple {

void write_png(const Picture& picture, const std::filesystem::path& path) {
  const std::size_t pixels = static_cast<std::size_t>(picture.width) * picture.height;
  SUPPLE_CHECK(pixels > 0 && picture.rgb.size() == 3 * pixels, "a picture has all its pixels");
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGB;
  image.flags = PNG_IMAGE_FLAG_FAST;

  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
  png_alloc_size_t size = bytes.size();
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.rgb.data(), 0, nullptr) ==
      0)
    throw OutputError(fmt::format("{}: libpng says {}", path.string(), image.message));

  OutputFile file(path);
  file.write(std::string_view(bytes).substr(0, size));
  file.commit();
}

}  // namespace supple
