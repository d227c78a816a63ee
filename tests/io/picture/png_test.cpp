#include <gtest/gtest.h>
#include <png.h>

#include "io/errors.h"
#include "io/picture/picture.h"
#include "tests/support/temporary_folder.h"

namespace supple {
namespace {

Picture noise(int width, int height) {
  Picture picture{width, height, {}};
  unsigned state = 7;
  for (int i = 0; i < 3 * width * height; ++i) {
    state = state * 1664525u + 1013904223u;
    picture.rgb.push_back(static_cast<std::uint8_t>(state >> 24));
  }
  return picture;
}

Picture read_png(const std::filesystem::path& path) {
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_file(&image, path.c_str()), 0) << image.message;
  EXPECT_EQ(image.format, static_cast<png_uint_32>(PNG_FORMAT_RGB));
  Picture picture{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  picture.rgb.resize(PNG_IMAGE_SIZE(image));
  EXPECT_NE(png_image_finish_read(&image, nullptr, picture.rgb.data(), 0, nullptr), 0);
  return picture;
}

TEST(Png, ComesBackPixelByPixel) {
  const TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{1, 1}, {37, 5}, {320, 200}}) {
    const Picture picture = noise(width, height);
    write_png(picture, folder / "picture.png");
    const Picture read = read_png(folder / "picture.png");
    EXPECT_EQ(read.width, width);
    EXPECT_EQ(read.height, height);
    EXPECT_EQ(read.rgb, picture.rgb);
  }
  EXPECT_EQ(folder.entries(), 1);
}

TEST(Png, NamesTheFileThatCannotBeWritten) {
  const TemporaryFolder folder;
  const std::string message =
      message_of<OutputError>([&] { write_png(noise(4, 4), folder / "missing" / "picture.png"); });
  EXPECT_NE(message.find("missing"), std::string::npos) << message;
}

}  // namespace
}  // namespace supple
