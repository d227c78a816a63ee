#include "modeler/cli/likely_size.h"

#include <fmt/format.h>

namespace supple {
namespace {

constexpr double smallest_likely = 1e-3, greatest_likely = 1e3;  // [m]

}  // namespace

double metres(FileUnit unit) {
  switch (unit) {
    case FileUnit::metre:
      return 1;
    case FileUnit::centimetre:
      return 0.01;
    case FileUnit::millimetre:
      return 0.001;
    case FileUnit::inch:
      return 0.0254;
  }
  return 1;
}

bool is_likely_size(double metres) {
  return metres >= smallest_likely && metres <= greatest_likely;
}

std::vector<std::string> size_notes(const Mesh& shape, const ShapeSpec& spec) {
  const double size = metres(spec.units) * bounding_box(shape.positions).diagonal();
  if (is_likely_size(size)) return {};
  return {
      fmt::format("the shape is {:.3g} m large, which is unlikely; shape.units says what one "
                  "unit of the file is (m, cm, mm, in)",
                  size)};
}

std::string length_text(double metres) {
  if (metres >= 1000) return fmt::format("{:.3g} km", metres / 1000);
  if (metres >= 1) return fmt::format("{:.3g} m", metres);
  if (metres >= 0.01) return fmt::format("{:.3g} cm", 100 * metres);
  if (metres >= 1e-4) return fmt::format("{:.3g} mm", 1000 * metres);
  return fmt::format("{:.3g} m", metres);
}

}  // namespace supple
