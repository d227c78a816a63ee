#include "modeler/cli/handle_arguments.h"

#include <algorithm>

#include <fmt/format.h>

#include "io/errors.h"
#include "modeler/cli/values.h"

namespace supple {
namespace {

Place place_of(const std::string& option, const std::string& value) {
  return {fmt::format("{} {}", option, value)};
}

}  // namespace

void HandleArguments::declare(CommandLine& line) {
  const auto bind = [this](void (HandleArguments::*set)(const std::string&)) {
    return [this, set](const std::string& value) { (this->*set)(value); };
  };
  line.begin_group("Handles");
  line.repeated_option("--fix", {"SELECTION", "hold this part of the surface where it is"},
                       bind(&HandleArguments::add_fix));
  line.repeated_option("--move", {"SELECTION", "lead this part of the surface elsewhere"},
                       bind(&HandleArguments::add_move));
  line.repeated_option(
      "--to",
      {"FILE",
       "lead each vertex of the --move before it to its place in FILE: a mesh or cloud of the same "
       "vertices, or text with lines \"number x y z\""},
      bind(&HandleArguments::set_to));
  line.repeated_option("--by",
                       {"X,Y,Z", "displacement of the --move before it, in file units or percent"},
                       bind(&HandleArguments::set_by));
  line.repeated_option("--turn", {"AX,AY,AZ,DEG", "turn the --move before it about this axis"},
                       bind(&HandleArguments::set_turn));
  line.repeated_option("--scale", {"S | X,Y,Z", "stretch the --move before it about its centre"},
                       bind(&HandleArguments::set_scale));
  line.repeated_option("--about", {"X,Y,Z", "point on the axis of that --turn"},
                       bind(&HandleArguments::set_about));
  line.repeated_option("--weight", {"W", "weight of the --fix or --move before it (default 1)"},
                       bind(&HandleArguments::set_weight));
}

std::vector<HandleSpec> HandleArguments::take() {
  std::vector<HandleSpec> handles;
  for (Draft& draft : drafts_) {
    if (draft.about && !draft.handle.turn)
      throw UsageError(fmt::format("--about: its {} has no --turn", draft.handle.place.file));
    if (draft.about) draft.handle.turn->about = draft.about;
    check_to(draft);
    handles.push_back(std::move(draft.handle));
  }
  drafts_.clear();
  return handles;
}

void HandleArguments::check_to(const Draft& draft) {
  if (!draft.handle.to) return;
  for (const std::string& option : draft.given)
    if (option == "--by" || option == "--turn" || option == "--scale")
      throw UsageError(fmt::format("{}: {} stands beside it; allowed: one of them",
                                   draft.handle.to->place.file, option));
}

void HandleArguments::add_fix(const std::string& selection) {
  Draft& draft = drafts_.emplace_back();
  draft.handle.place = place_of("--fix", selection);
  draft.handle.fix = parse_selection(selection, draft.handle.place);
}

void HandleArguments::add_move(const std::string& selection) {
  Draft& draft = drafts_.emplace_back();
  draft.handle.place = place_of("--move", selection);
  draft.handle.move = parse_selection(selection, draft.handle.place);
}

void HandleArguments::set_by(const std::string& value) {
  last_move("--by", value).handle.by = parse_length_vector(value, place_of("--by", value));
}

void HandleArguments::set_to(const std::string& value) {
  Draft& draft = last_move("--to", value);
  draft.handle.to = NamedFile{absolute_path(value), place_of("--to", value)};
}

void HandleArguments::set_turn(const std::string& value) {
  Draft& draft = last_move("--turn", value);
  const std::vector<double> numbers = parse_numbers(value, "--turn", "AX,AY,AZ,DEG (0,0,1,30)");
  if (numbers.size() != 4)
    throw UsageError(
        fmt::format("--turn {}: allowed: four numbers, the axis and the degrees "
                    "(0,0,1,30)",
                    value));
  const Vec3 axis(numbers[0], numbers[1], numbers[2]);
  if (axis.squaredNorm() == 0)
    throw UsageError(fmt::format("--turn {}: the axis must have a length", value));
  draft.handle.turn = TurnSpec{axis, numbers[3], {}};
}

void HandleArguments::set_scale(const std::string& value) {
  Draft& draft = last_move("--scale", value);
  const std::vector<double> s = parse_numbers(value, "--scale", "one factor, or X,Y,Z");
  const bool positive = std::all_of(s.begin(), s.end(), [](double factor) { return factor > 0; });
  if (!positive || (s.size() != 1 && s.size() != 3))
    throw UsageError(
        fmt::format("--scale {}: allowed: one factor, or three as X,Y,Z, all above 0", value));
  draft.handle.scale = s.size() == 1 ? Vec3(Vec3::Constant(s[0])) : Vec3(s[0], s[1], s[2]);
}

void HandleArguments::set_about(const std::string& value) {
  last_move("--about", value).about = parse_length_vector(value, place_of("--about", value));
}

void HandleArguments::set_weight(const std::string& value) {
  Draft& draft = last_handle("--weight", value);
  draft.handle.weight = parse_number(value, "--weight");
  if (draft.handle.weight <= 0)
    throw UsageError(fmt::format("--weight {}: allowed: a number above 0", value));
}

HandleArguments::Draft& HandleArguments::last_move(const std::string& option,
                                                   const std::string& value) {
  Draft& draft = last_handle(option, value);
  if (!draft.handle.move)
    throw UsageError(
        fmt::format("{} {}: stands behind {}, which holds its part in place; "
                    "allowed: only behind a --move",
                    option, value, draft.handle.place.file));
  return draft;
}

HandleArguments::Draft& HandleArguments::last_handle(const std::string& option,
                                                     const std::string& value) {
  if (drafts_.empty())
    throw UsageError(
        fmt::format("{} {}: no --move stands before it, to which it could belong", option, value));
  Draft& draft = drafts_.back();
  if (std::find(draft.given.begin(), draft.given.end(), option) != draft.given.end())
    throw UsageError(
        fmt::format("{} {}: given twice for {}", option, value, draft.handle.place.file));
  draft.given.push_back(option);
  return draft;
}

}  // namespace supple
