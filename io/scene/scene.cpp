#include "io/scene/scene.h"

#include <array>

namespace supple {

EnumNames<QuadratureKind> enum_names(QuadratureKind) {
  static constexpr std::array<std::pair<QuadratureKind, std::string_view>, 3> names{{
      {QuadratureKind::automatic, "auto"},
      {QuadratureKind::particles, "particles"},
      {QuadratureKind::cells, "cells"},
  }};
  return names;
}

EnumNames<CouplingKind> enum_names(CouplingKind) {
  static constexpr std::array<std::pair<CouplingKind, std::string_view>, 2> names{{
      {CouplingKind::inside, "inside"},
      {CouplingKind::straight, "straight"},
  }};
  return names;
}

EnumNames<PlacementKind> enum_names(PlacementKind) {
  static constexpr std::array<std::pair<PlacementKind, std::string_view>, 2> names{{
      {PlacementKind::even, "even"},
      {PlacementKind::octree, "octree"},
  }};
  return names;
}

EnumNames<FileUnit> enum_names(FileUnit) {
  static constexpr std::array<std::pair<FileUnit, std::string_view>, 4> names{{
      {FileUnit::metre, "m"},
      {FileUnit::centimetre, "cm"},
      {FileUnit::millimetre, "mm"},
      {FileUnit::inch, "in"},
  }};
  return names;
}

EnumNames<SurfaceKind> enum_names(SurfaceKind) {
  static constexpr std::array<std::pair<SurfaceKind, std::string_view>, 2> names{{
      {SurfaceKind::field, "field"},
      {SurfaceKind::particle_gradients, "particle_gradients"},
  }};
  return names;
}

}  // namespace supple
