#include "io/chart/sketch.h"

namespace supple {

void Sketch::add(const SketchLine& line) {
  shapes.emplace_back(line);
}

void Sketch::add(const SketchArea& area) {
  shapes.emplace_back(area);
}

void Sketch::add(const SketchCircle& circle) {
  shapes.emplace_back(circle);
}

void Sketch::add(const SketchText& text) {
  shapes.emplace_back(text);
}

}  // namespace supple
