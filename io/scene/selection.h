#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/scene/quantity.h"

namespace supple {

/// A part of a shape's surface, as the user named it: a tree of half-spaces, boxes, spheres,
/// vertex lists and groups, joined by and, or, not.
struct Selection {
  enum class Kind { compare, box, sphere, nearest, vertices, group, all, any, negation };
  enum class Order { less, less_equal, greater, greater_equal };

  Kind kind = Kind::compare;
  Place place;
  std::string text;  ///< as the user wrote it

  int axis = 0;                  ///< compare: 0, 1, 2 for x, y, z
  Order order = Order::less;     ///< compare
  Length bound;                  ///< compare: percent of the bounding box along that axis
  LengthVector lower, upper;     ///< box: corners
  LengthVector center;           ///< sphere, nearest
  Length radius;                 ///< sphere
  std::string name;              ///< vertices: file (relative to the scene file); group: name
  std::vector<Selection> parts;  ///< all (and), any (or): two or more; negation: one
};

/// Reads the grammar of selections:
///
///     or-list   := and-list { "or" and-list }
///     and-list  := unary { "and" unary }
///     unary     := "not" unary | "(" or-list ")" | atom
///     atom      := axis ("<"|"<="|">"|">=") length      y<10%   (percent of the box along y)
///                | axis ":" length ".." | axis ":" ".." length      y:85%..   y:..10%
///                | "box(" 6 lengths ")" | "sphere(" 4 lengths ")" | "nearest(" 3 lengths ")"
///                | "vertices(" file ")" | "group(" name ")"
///
/// Errors: UsageError with the place, the column inside `text`, what is allowed there and the
/// nearest valid name; a bare axis gets "incomplete: quote it" (a shell swallowed the rest).
Selection parse_selection(const std::string& text, const Place& place);

}  // namespace supple
