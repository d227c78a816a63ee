#include "io/scene/selection_check.h"

#include <fmt/format.h>

#include "io/scene/complaint.h"

namespace supple {
namespace {

void check_corners(const Selection& selection, const std::string& what) {
  check_units(selection.lower, selection.place, what);
  check_units(selection.upper, selection.place, what);
  if (has_percent(selection.lower) != has_percent(selection.upper))
    complain(selection.place, fmt::format("{}: one corner is in percent, from the centre of the "
                                          "shape's box, the other is not; allowed: both in "
                                          "percent (0% is the centre) or none",
                                          what));
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (selection.lower[axis].value > selection.upper[axis].value)
      complain(selection.place,
               fmt::format("{}: along {} the lower corner {} is above the upper corner {}", what,
                           "xyz"[axis], to_string(selection.lower[axis]),
                           to_string(selection.upper[axis])));
}

}  // namespace

void check_selection(const Selection& selection) {
  using Kind = Selection::Kind;
  const std::string what = fmt::format("in the selection {}", in_quotes(selection.text));
  if (selection.kind == Kind::box) check_corners(selection, what);
  if (selection.kind == Kind::sphere || selection.kind == Kind::nearest)
    check_units(selection.center, selection.place, what);
  if (selection.kind == Kind::sphere && selection.radius.value <= 0)
    complain(selection.place,
             fmt::format("{}: the radius = {}, must be > 0", what, to_string(selection.radius)));
  if ((selection.kind == Kind::vertices || selection.kind == Kind::group) && selection.name.empty())
    complain(selection.place, fmt::format("{}: a name is missing in the parentheses", what));
}

}  // namespace supple
