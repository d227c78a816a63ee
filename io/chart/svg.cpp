#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "io/chart/sketch.h"

namespace supple {
namespace {

using Buffer = fmt::memory_buffer;

template <class... Args>
void add(Buffer& text, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
}

std::string color_text(const Color& color) {
  const auto byte = [&](std::size_t i) { return std::lround(255 * color[i]); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(0), byte(1), byte(2));
}

std::string points_text(const std::vector<Pixel>& points) {
  Buffer text;
  for (const Pixel& point : points) add(text, "{:.2f},{:.2f} ", point.x(), point.y());
  return fmt::to_string(text);
}

std::string opacity_text(std::string_view what, double opacity) {
  return opacity < 1 ? fmt::format(" {}-opacity=\"{:.3g}\"", what, opacity) : std::string();
}

void write(const SketchLine& line, Buffer& text) {
  const std::string dash =
      line.dash > 0 ? fmt::format(" stroke-dasharray=\"{0:g} {0:g}\"", line.dash) : std::string();
  add(text, "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\"{}{}/>\n",
      points_text(line.points), color_text(line.color), line.width, dash,
      opacity_text("stroke", line.opacity));
}

void write(const SketchArea& area, Buffer& text) {
  add(text, "<polygon points=\"{}\" fill=\"{}\"{}/>\n", points_text(area.corners),
      color_text(area.color), opacity_text("fill", area.opacity));
}

void write(const SketchCircle& circle, Buffer& text) {
  const std::string color = color_text(circle.color);
  const std::string paint =
      circle.ring > 0
          ? fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\"", color, circle.ring)
          : fmt::format("fill=\"{}\"", color);
  add(text, "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:g}\" {}/>\n", circle.center.x(),
      circle.center.y(), circle.radius, paint);
}

void write(const SketchText& label, Buffer& text) {
  constexpr const char* anchors[] = {"start", "middle", "end"};
  constexpr double below_middle = 5;  // from mid-height to the base line [px]
  add(text, "<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"{}\" fill=\"{}\">{}</text>\n",
      label.at.x(), label.at.y() + below_middle, anchors[static_cast<int>(label.anchor)],
      color_text(label.color), xml_text(label.text));
}

}  // namespace

std::string svg(const Sketch& sketch) {
  Buffer text;
  // A letter of a monospaced font is 0.6 of its size wide.
  add(text,
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\" font-family=\"'DejaVu Sans Mono', monospace\" font-size=\"{2:g}\" "
      "stroke-linejoin=\"round\" stroke-linecap=\"round\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
      sketch.width, sketch.height, letter_width / 0.6);
  for (const SketchShape& shape : sketch.shapes)
    std::visit([&](const auto& each) { write(each, text); }, shape);
  add(text, "</svg>\n");
  return fmt::to_string(text);
}

}  // namespace supple
