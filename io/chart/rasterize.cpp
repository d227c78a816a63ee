#include <algorithm>
#include <cmath>
#include <limits>

#include "io/chart/sketch.h"
#include "io/picture/font.h"

namespace supple {
namespace {

/// A picture that takes ink.
class Canvas {
 public:
  Canvas(int width, int height)
      : picture_{width, height,
                 std::vector<std::uint8_t>(3 * static_cast<std::size_t>(width) * height, 255)} {}

  Picture take() { return std::move(picture_); }

  /// Covers each pixel that may lie within `frame` by coverage(middle of the pixel) in [0, 1].
  template <class Coverage>
  void paint(const Frame& frame, const Color& color, double opacity, const Coverage& coverage) {
    const int left = clamped(frame.left - 1, picture_.width);
    const int right = clamped(frame.right + 2, picture_.width);
    const int top = clamped(frame.top - 1, picture_.height);
    const int bottom = clamped(frame.bottom + 2, picture_.height);
    for (int y = top; y < bottom; ++y)
      for (int x = left; x < right; ++x)
        blend(x, y, color, opacity * coverage(Pixel(x + 0.5, y + 0.5)));
  }

 private:
  static int clamped(double value, int most) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(most)));
  }

  void blend(int x, int y, const Color& color, double share) {
    std::uint8_t* const bytes =
        &picture_.rgb[3 * (static_cast<std::size_t>(y) * picture_.width + x)];
    for (std::size_t i = 0; i < 3; ++i)
      bytes[i] = static_cast<std::uint8_t>(
          std::lround((1 - share) * bytes[i] + share * 255 * static_cast<double>(color[i])));
  }

  Picture picture_;
};

Frame bounds(const std::vector<Pixel>& points, double margin) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Frame frame{infinity, infinity, -infinity, -infinity};
  for (const Pixel& point : points) {
    frame.left = std::min(frame.left, point.x() - margin);
    frame.right = std::max(frame.right, point.x() + margin);
    frame.top = std::min(frame.top, point.y() - margin);
    frame.bottom = std::max(frame.bottom, point.y() + margin);
  }
  return frame;
}

double distance_to_segment(const Pixel& p, const Pixel& a, const Pixel& b) {
  const Pixel along = b - a;
  const double square = along.squaredNorm();
  const double t = square > 0 ? std::clamp((p - a).dot(along) / square, 0.0, 1.0) : 0.0;
  return (p - a - t * along).norm();
}

/// How much of a pixel is within a border, of which its middle is `beyond` px outside.
double soft_edge(double beyond) {
  return std::clamp(0.5 - beyond, 0.0, 1.0);
}

void draw_solid(const SketchLine& line, Canvas& canvas) {
  const double half = line.width / 2;
  canvas.paint(bounds(line.points, half), line.color, line.opacity, [&](const Pixel& p) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < line.points.size(); ++i)
      nearest = std::min(nearest, distance_to_segment(p, line.points[i - 1], line.points[i]));
    return soft_edge(nearest - half);
  });
}

/// The dashes of a line, each a line of its own.
std::vector<SketchLine> dashes_of(const SketchLine& line) {
  std::vector<SketchLine> dashes;
  double from_start = 0;
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    const Pixel a = line.points[i - 1], b = line.points[i];
    const double length = (b - a).norm();
    for (double at = 0; at < length;) {
      const double in_period = std::fmod(from_start + at, 2 * line.dash);
      const bool inked = in_period < line.dash;
      const double end = std::min(length, at + (inked ? 1 : 2) * line.dash - in_period + 1e-6);
      if (inked)
        dashes.push_back({{a + (b - a) * (at / length), a + (b - a) * (end / length)},
                          line.color,
                          line.width,
                          0,
                          line.opacity});
      at = end;
    }
    from_start += length;
  }
  return dashes;
}

void draw(const SketchLine& line, Canvas& canvas) {
  if (line.points.size() < 2) return;
  if (line.dash > 0)
    for (const SketchLine& dash : dashes_of(line)) draw_solid(dash, canvas);
  else
    draw_solid(line, canvas);
}

/// By the number of the polygon's edges to the right.
bool is_inside(const Pixel& p, const std::vector<Pixel>& corners) {
  bool inside = false;
  for (std::size_t i = 0, before = corners.size() - 1; i < corners.size(); before = i++) {
    const Pixel &a = corners[before], &b = corners[i];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

void draw(const SketchArea& area, Canvas& canvas) {
  constexpr int parts = 4;  // of a pixel along x and y
  canvas.paint(bounds(area.corners, 0), area.color, area.opacity, [&](const Pixel& p) {
    int hits = 0;
    for (int i = 0; i < parts * parts; ++i) {
      const Pixel part(i % parts, i / parts);
      const Pixel inner = p + (part.array() + 0.5).matrix() / parts - Pixel::Constant(0.5);
      hits += is_inside(inner, area.corners) ? 1 : 0;
    }
    return static_cast<double>(hits) / (parts * parts);
  });
}

void draw(const SketchCircle& circle, Canvas& canvas) {
  const double reach = circle.radius + circle.ring / 2;
  canvas.paint(bounds({circle.center}, reach), circle.color, 1, [&](const Pixel& p) {
    const double distance = (p - circle.center).norm();
    return soft_edge(circle.ring > 0 ? std::abs(distance - circle.radius) - circle.ring / 2
                                     : distance - circle.radius);
  });
}

/// One byte a letter; "?" for each outside ASCII.
std::string ascii(std::string_view text) {
  std::string letters;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0) != 0x80) letters += byte < 0x80 ? c : '?';
  }
  return letters;
}

void draw(const SketchText& label, Canvas& canvas) {
  const std::string text = ascii(label.text);
  const double width = letter_width * static_cast<double>(text.size());
  const double left = std::round(label.at.x() - width * static_cast<int>(label.anchor) / 2);
  constexpr double above_middle = 8;  // from the top of a capital to mid-height [px]
  const double top = std::round(label.at.y() - above_middle);
  const Frame frame{left, top, left + width, top + glyph_height};
  canvas.paint(frame, label.color, 1, [&](const Pixel& p) {
    const int x = static_cast<int>(std::floor(p.x() - left));
    const int y = static_cast<int>(std::floor(p.y() - top));
    if (x < 0 || y < 0 || y >= glyph_height || x >= static_cast<int>(width)) return 0.0;
    const char letter = text[static_cast<std::size_t>(x / glyph_width)];
    return glyph_pixel(letter, x % glyph_width, y) ? 1.0 : 0.0;
  });
}

}  // namespace

Picture rasterize(const Sketch& sketch) {
  static_assert(letter_width == glyph_width);
  Canvas canvas(sketch.width, sketch.height);
  for (const SketchShape& shape : sketch.shapes)
    std::visit([&](const auto& each) { draw(each, canvas); }, shape);
  return canvas.take();
}

}  // namespace supple
