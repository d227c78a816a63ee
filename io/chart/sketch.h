#pragma once

#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

#include "io/picture/picture.h"

namespace supple {

// What a chart is drawn of: flat shapes in pixels, x to the right and y downwards, each over those
// before it. A vector graphic and a picture are made of the same.

using Pixel = Eigen::Vector2d;

struct SketchLine {
  std::vector<Pixel> points;
  Color color{0, 0, 0};
  double width = 1;  ///< [px]
  double dash = 0;   ///< length of dashes and gaps [px]; 0: none
  double opacity = 1;
};

/// A polygon, filled.
struct SketchArea {
  std::vector<Pixel> corners;
  Color color{0, 0, 0};
  double opacity = 1;
};

struct SketchCircle {
  Pixel center = Pixel::Zero();
  double radius = 1;  ///< [px]
  Color color{0, 0, 0};
  double ring = 0;  ///< width of its line [px]; 0: filled
};

/// One line of text that starts, ends or has its middle at a place; `at` is on its mid-height.
struct SketchText {
  enum class Anchor { start, middle, end };
  Pixel at = Pixel::Zero();
  std::string text;
  Anchor anchor = Anchor::start;
  Color color{0.15f, 0.15f, 0.18f};
};

using SketchShape = std::variant<SketchLine, SketchArea, SketchCircle, SketchText>;

struct Sketch {
  int width = 0, height = 0;  ///< [px]
  std::vector<SketchShape> shapes = {};

  void add(const SketchLine& line);
  void add(const SketchArea& area);
  void add(const SketchCircle& circle);
  void add(const SketchText& text);
};

/// Part of a sketch.
struct Frame {
  double left = 0, top = 0, right = 0, bottom = 0;  ///< [px]

  std::vector<Pixel> corners() const {
    return {{left, top}, {right, top}, {right, bottom}, {left, bottom}};
  }
};

constexpr double letter_width = 9;  ///< of every letter of a sketch [px]

/// An <svg> element. Text is escaped; bytes that are not UTF-8 become U+FFFD.
std::string svg(const Sketch& sketch);

/// The same in pixels; letters outside ASCII are drawn as "?".
Picture rasterize(const Sketch& sketch);

/// `text` for XML: markup is escaped, what XML does not allow becomes U+FFFD.
std::string xml_text(std::string_view text);

}  // namespace supple
