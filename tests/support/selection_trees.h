#pragma once

#include <string>

#include "io/scene/selection.h"

namespace supple::test {

inline std::string show(const LengthVector& v) {
  return to_string(v[0]) + " " + to_string(v[1]) + " " + to_string(v[2]);
}

inline std::string show_parts(const std::string& joint, const Selection& s);

/// The tree of a selection, everything it holds, as an S-expression: "(and (y < 10%) (not …))".
inline std::string show(const Selection& s) {
  using Kind = Selection::Kind;
  static const char* const orders[] = {"<", "<=", ">", ">="};
  switch (s.kind) {
    case Kind::compare:
      return std::string("(") + "xyz"[s.axis] + " " + orders[int(s.order)] + " " +
             to_string(s.bound) + ")";
    case Kind::box:
      return "(box " + show(s.lower) + " | " + show(s.upper) + ")";
    case Kind::sphere:
      return "(sphere " + show(s.center) + " | " + to_string(s.radius) + ")";
    case Kind::nearest:
      return "(nearest " + show(s.center) + ")";
    case Kind::vertices:
      return "(vertices '" + s.name + "')";
    case Kind::group:
      return "(group '" + s.name + "')";
    case Kind::all:
      return show_parts("and", s);
    case Kind::any:
      return show_parts("or", s);
    case Kind::negation:
      return show_parts("not", s);
  }
  return "?";
}

inline std::string show_parts(const std::string& joint, const Selection& s) {
  std::string text = "(" + joint;
  for (const Selection& part : s.parts) text += " " + show(part);
  return text + ")";
}

}  // namespace supple::test
