#include "io/picture/picture.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "io/errors.h"
#include "io/picture/ambient_occlusion.h"
#include "io/picture/font.h"
#include "io/picture/painter.h"

namespace supple {
namespace {

constexpr int least_size = 16, greatest_size = 8192;  // [px]

void check_options(const PictureOptions& options, std::size_t items) {
  const auto allowed = [](int size) { return size >= least_size && size <= greatest_size; };
  if (!allowed(options.width) || !allowed(options.height))
    throw UsageError(fmt::format("picture size {}x{}: each side must have {} to {} pixels",
                                 options.width, options.height, least_size, greatest_size));
  if (items > static_cast<std::size_t>(options.width / least_size))
    throw UsageError(
        fmt::format("a picture {} pixels wide has no room for {} views", options.width, items));
  const Camera& camera = options.camera;
  if (!camera.up.allFinite() || camera.up.norm() == 0)
    throw UsageError("the camera's up must be a direction other than 0, 0, 0");
  if (!(camera.zoom > 0 && std::isfinite(camera.zoom)))
    throw UsageError(fmt::format("camera zoom {}: must be > 0", camera.zoom));
  if (!std::isfinite(camera.azimuth_deg) || !(std::abs(camera.elevation_deg) <= 90))
    throw UsageError(fmt::format("camera azimuth {}, elevation {}: elevation must be -90 to 90",
                                 camera.azimuth_deg, camera.elevation_deg));
}

bool has_labels(const std::vector<PictureItem>& items) {
  return std::any_of(items.begin(), items.end(), [](const auto& i) { return !i.label.empty(); });
}

void draw_labels(const std::vector<PictureItem>& items, const View& view, int scale,
                 Picture& picture) {
  const int top = view.height - view.label_height + (view.label_height - glyph_height * scale) / 3;
  int left = 0;
  for (const PictureItem& item : items) {
    draw_label({item.label, left + view.column_width / 2, top, view.column_width, scale}, picture);
    left += view.column_width;
  }
}

void draw_notes(const std::vector<PictureItem>& items, const View& view, int scale,
                Picture& picture) {
  int left = 0;
  for (const PictureItem& item : items) {
    for (const Note& note : item.notes) {
      const Eigen::Vector2d middle = pixel_of(note.position, view);
      draw_label({note.text, left + static_cast<int>(std::lround(middle.x())),
                  static_cast<int>(std::lround(middle.y())) - glyph_height * scale / 2,
                  view.column_width, scale},
                 picture);
    }
    left += view.column_width;
  }
}

}  // namespace

Picture render(const std::vector<PictureItem>& items, const PictureOptions& options) {
  check_options(options, items.size());
  std::vector<Drawing> drawings;
  drawings.reserve(items.size());
  for (const PictureItem& item : items) drawings.push_back(make_drawing(item));
  const int label_scale = std::max(1, options.height / 720);
  const int label_height = has_labels(items) ? 3 * glyph_height * label_scale : 0;
  const View view = fit_view(drawings, options, label_height);

  Painter painter(options.width, options.height);
  const int columns = static_cast<int>(drawings.size());
  for (int i = 0; i < columns; ++i)
    painter.draw_shape(drawings[i], view, {i, options.ground_shadow});
  const std::vector<float> depth = painter.depth(view);  // markers throw no shade on the shape
  for (int i = 0; i < columns; ++i) {
    painter.draw_markers(drawings[i], view, i);
    painter.draw_lines(drawings[i], view, i);
    painter.draw_veil(drawings[i], view, i);
  }

  Picture picture = painter.picture();
  shade_hollows(depth, picture);
  draw_labels(items, view, label_scale, picture);
  draw_notes(items, view, label_scale, picture);
  return picture;
}

}  // namespace supple
