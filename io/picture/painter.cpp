#include "io/picture/painter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "io/picture/contact_shadow.h"
#include "io/picture/shaders.h"
#include "io/picture/splat_painter.h"
#include "io/picture/vertex_array.h"
#include "solver/core/parallel.h"

namespace supple {
namespace {

constexpr int fineness = 2;  // of the canvas, against the picture: smooths its edges

constexpr float background_depth = -std::numeric_limits<float>::infinity();

/// The pixels of the canvas that become one pixel of the picture.
struct FinePixels {
  Index row_length, left, bottom;

  std::uint8_t mean(const std::vector<std::uint8_t>& rgba, int channel) const {
    int sum = fineness * fineness / 2;
    for (Index y = bottom; y < bottom + fineness; ++y)
      for (Index x = left; x < left + fineness; ++x)
        sum += rgba[4 * (y * row_length + x) + channel];
    return static_cast<std::uint8_t>(sum / (fineness * fineness));
  }

  float least(const std::vector<float>& values) const {
    float least = values[bottom * row_length + left];
    for (Index y = bottom; y < bottom + fineness; ++y)
      for (Index x = left; x < left + fineness; ++x)
        least = std::min(least, values[y * row_length + x]);
    return least;
  }
};

/// Calls body(pixel of the picture, top row first; pixels of the canvas that become it).
template <class Body>
void for_each_pixel(int width, int height, const Body& body) {
  parallel_chunks(height, 16, [&](Index begin, Index end) {
    for (Index y = begin; y < end; ++y)
      for (Index x = 0; x < width; ++x)
        body(y * width + x,
             FinePixels{fineness * width, fineness * x, fineness * (height - 1 - y)});
  });
}

PointScale point_scale(const Drawing& drawing, const std::vector<DrawnVertex>& points,
                       const View& view) {
  const double pixels = fineness * view.pixels_per_meter;
  return {.px_per_unit = pixels * drawing.size,
          .default_px = fineness * suitable_radius_px(drawing, points, view),
          .depth_per_px = 1 / (2 * pixels * view.depth)};
}

/// Lines as strips that face the viewer, a little in front of what they lie on: OpenGL itself need
/// not draw lines wider than a pixel.
DrawnSheet strips_of(const DrawnLines& lines, const Drawing& drawing, const View& view) {
  const double half_width = 0.5 * lines.width / (view.pixels_per_meter * drawing.size);
  const Vec3 towards = view.rotation.row(2);
  DrawnSheet strips;
  strips.vertices.reserve(2 * lines.ends.size());
  for (std::size_t i = 0; i + 1 < lines.ends.size(); i += 2) {
    const auto point = [&](std::size_t end) {
      const auto& x = lines.ends[end].position;
      return Vec3(x[0], x[1], x[2]);
    };
    const Vec3 across = towards.cross(point(i + 1) - point(i)).normalized();
    const auto first = static_cast<std::uint32_t>(strips.vertices.size());
    for (const std::size_t end : {i, i + 1})
      for (const double side : {-half_width, half_width}) {
        const Vec3 x = point(end) + side * across + half_width * towards;
        strips.vertices.push_back(lines.ends[end]);
        for (int k = 0; k < 3; ++k) strips.vertices.back().position[k] = static_cast<float>(x[k]);
      }
    for (const std::uint32_t corner : {0, 1, 2, 2, 1, 3}) strips.indices.push_back(first + corner);
  }
  return strips;
}

}  // namespace

Painter::Painter(int width, int height)
    : width_(width),
      height_(height),
      gl_(context_.gl()),
      background_(gl_, {shaders::background_vertex}, {shaders::background_fragment}),
      surface_(gl_, {shaders::surface_vertex}, {shaders::lighting, shaders::surface_fragment}),
      ball_(gl_, {shaders::point_size, shaders::ball_vertex},
            {shaders::lighting, shaders::ball_fragment}),
      flat_(gl_, {shaders::flat_vertex}, {shaders::flat_fragment}),
      ground_(gl_, {shaders::ground_vertex}, {shaders::ground_fragment}),
      canvas_(gl_, fineness * width, fineness * height) {
  gl_.enable(GL_PROGRAM_POINT_SIZE);
  gl_.enable(GL_SCISSOR_TEST);
  gl_.pixel_store(GL_PACK_ALIGNMENT, 1);
  gl_.scissor(0, 0, fineness * width, fineness * height);
  gl_.viewport(0, 0, fineness * width, fineness * height);
  gl_.clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  draw_background();
}

void Painter::draw_background() const {
  const VertexArray none(gl_, {});
  background_.use();
  gl_.draw_arrays(GL_TRIANGLES, 0, 3);
}

void Painter::use_column(const View& view, int column) const {
  const int left = fineness * column * view.column_width;
  gl_.viewport(left, 0, fineness * view.column_width, fineness * height_);
  gl_.scissor(left, 0, fineness * view.column_width, fineness * height_);
}

void Painter::draw_shape(const Drawing& drawing, const View& view, const Place& place) const {
  use_column(view, place.column);
  const bool is_surface = !drawing.indices.empty() || !drawing.splats.empty();
  if (is_surface && place.ground_shadow && view.rotation.row(2).dot(view.up) > 0)
    draw_shadow(drawing, view);
  if (!drawing.indices.empty() && drawing.opacity >= 1) draw_surface(drawing, view);
  if (!drawing.splats.empty()) draw_splats(drawing, view, place.column);
  for (const DrawnSheet& sheet : drawing.sheets) draw_flat(drawing, sheet, view);
  draw_balls(drawing, drawing.balls, view);
}

void Painter::draw_markers(const Drawing& drawing, const View& view, int column) const {
  use_column(view, column);
  for (const std::vector<DrawnVertex>& balls : drawing.markers) draw_balls(drawing, balls, view);
}

void Painter::draw_lines(const Drawing& drawing, const View& view, int column) const {
  use_column(view, column);
  for (const DrawnLines& lines : drawing.lines)
    draw_flat(drawing, strips_of(lines, drawing, view), view);
}

void Painter::draw_veil(const Drawing& drawing, const View& view, int column) const {
  if (drawing.opacity >= 1 || drawing.indices.empty()) return;
  use_column(view, column);
  // The depth alone first, so that the colour of the nearest side only is laid over the rest.
  gl_.color_mask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  draw_surface(drawing, view);
  gl_.color_mask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl_.depth_function(GL_EQUAL);
  gl_.enable(GL_BLEND);
  gl_.blend_function(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  draw_surface(drawing, view);
  gl_.disable(GL_BLEND);
  gl_.depth_function(GL_LESS);
}

void Painter::draw_flat(const Drawing& drawing, const DrawnSheet& sheet, const View& view) const {
  if (sheet.indices.empty()) return;
  const VertexArray array(gl_, sheet.vertices, sheet.indices);
  flat_.use();
  flat_.set("to_clip", clip_from(view, world_from_drawing(drawing)));
  gl_.enable(GL_DEPTH_TEST);
  gl_.draw_elements(GL_TRIANGLES, static_cast<GLsizei>(sheet.indices.size()), GL_UNSIGNED_INT,
                    nullptr);
  gl_.disable(GL_DEPTH_TEST);
}

void Painter::draw_surface(const Drawing& drawing, const View& view) const {
  const VertexArray array(gl_, drawing.vertices, drawing.indices);
  surface_.use();
  surface_.set("to_clip", clip_from(view, world_from_drawing(drawing)));
  surface_.set("to_view", view.rotation);
  surface_.set("cut", drawing.cut);
  surface_.set("opacity", drawing.opacity);
  gl_.enable(GL_DEPTH_TEST);
  gl_.draw_elements(GL_TRIANGLES, static_cast<GLsizei>(drawing.indices.size()), GL_UNSIGNED_INT,
                    nullptr);
  gl_.disable(GL_DEPTH_TEST);
}

void Painter::draw_splats(const Drawing& drawing, const View& view, int column) const {
  const SplatPainter splats(gl_, fineness * view.column_width, fineness * height_);
  gl_.viewport(0, 0, fineness * view.column_width, fineness * height_);
  gl_.scissor(0, 0, fineness * view.column_width, fineness * height_);
  splats.gather(drawing, view, point_scale(drawing, drawing.splats, view));
  gl_.bind_framebuffer(GL_FRAMEBUFFER, canvas_.id());
  use_column(view, column);
  splats.resolve(fineness * column * view.column_width);
}

void Painter::draw_balls(const Drawing& drawing, const std::vector<DrawnVertex>& balls,
                         const View& view) const {
  if (balls.empty()) return;
  const VertexArray array(gl_, balls);
  ball_.use();
  ball_.set("to_clip", clip_from(view, world_from_drawing(drawing)));
  point_scale(drawing, balls, view).set(ball_);
  gl_.enable(GL_DEPTH_TEST);
  gl_.draw_arrays(GL_POINTS, 0, static_cast<GLsizei>(balls.size()));
  gl_.disable(GL_DEPTH_TEST);
}

void Painter::draw_shadow(const Drawing& drawing, const View& view) const {
  const GroundRect rect = ground_below(drawing, view);
  if (rect.across.isZero(0)) return;
  const std::vector<std::uint8_t> map = contact_shadow(drawing, rect, view);
  const GlObject texture(gl_.gen_textures, gl_.delete_textures);
  gl_.bind_texture(GL_TEXTURE_2D, texture.id());
  gl_.texture_image(GL_TEXTURE_2D, 0, GL_R8, shadow_map_side, shadow_map_side, 0, GL_RED,
                    GL_UNSIGNED_BYTE, map.data());
  gl_.texture_parameter(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_.texture_parameter(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl_.texture_parameter(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);

  const VertexArray none(gl_, {});
  ground_.use();
  ground_.set("to_clip", clip_from(view, world_from_ground(rect)));
  gl_.enable(GL_BLEND);
  gl_.blend_function(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl_.draw_arrays(GL_TRIANGLE_STRIP, 0, 4);
  gl_.disable(GL_BLEND);
}

template <class Value>
std::vector<Value> Painter::read_canvas(GLenum format, GLenum type, int channels) const {
  const int width = fineness * width_, height = fineness * height_;
  std::vector<Value> values(static_cast<std::size_t>(channels) * width * height);
  gl_.read_pixels(0, 0, width, height, format, type, values.data());
  return values;
}

std::vector<float> Painter::depth(const View& view) const {
  const auto fine = read_canvas<float>(GL_DEPTH_COMPONENT, GL_FLOAT, 1);
  const float scale = static_cast<float>(view.depth * view.pixels_per_meter);
  std::vector<float> result(static_cast<std::size_t>(width_) * height_);
  for_each_pixel(width_, height_, [&](Index pixel, const FinePixels& of) {
    const float nearest = of.least(fine);
    result[pixel] = nearest < 1 ? (1 - 2 * nearest) * scale : background_depth;
  });
  return result;
}

Picture Painter::picture() const {
  const auto fine = read_canvas<std::uint8_t>(GL_RGBA, GL_UNSIGNED_BYTE, 4);
  Picture result{width_, height_, {}};
  result.rgb.resize(3 * static_cast<std::size_t>(width_) * height_);
  for_each_pixel(width_, height_, [&](Index pixel, const FinePixels& of) {
    for (int c = 0; c < 3; ++c) result.rgb[3 * pixel + c] = of.mean(fine, c);
  });
  return result;
}

}  // namespace supple
