#include "modeler/cli/part_arguments.h"

#include <fmt/format.h>

#include "io/errors.h"
#include "modeler/cli/values.h"

namespace supple {

void PartArguments::declare(CommandLine& line) {
  line.begin_group("Beside handles");
  line.option("--from", {"FILE", "the shape in another pose, where the handles' way starts"},
              [this](const std::string& value) {
                from_ = NamedFile{absolute_path(value), {"--from " + value}};
              });
  line.repeated_option("--stiffen", {"SELECTION", "make this part stiffer, with its inside"},
                       [this](const std::string& value) { add_stiffness(value); });
  line.repeated_option("--times", {"N", "how many times as stiff the --stiffen before it is"},
                       [this](const std::string& value) { set_times(value); });
}

bool PartArguments::given() const {
  return !stiffness_.empty() || from_;
}

void PartArguments::give(PoseSpec& pose) const {
  if (from_) pose.from = from_;
  check_times();
  pose.stiffness.insert(pose.stiffness.end(), stiffness_.begin(), stiffness_.end());
}

void PartArguments::check_times() const {
  if (with_times_ < stiffness_.size())
    throw UsageError(fmt::format("{}: --times is missing behind it, as in --times 5",
                                 stiffness_.back().place.file));
}

void PartArguments::add_stiffness(const std::string& selection) {
  const Place place{fmt::format("--stiffen {}", selection)};
  check_times();
  stiffness_.push_back({place, parse_selection(selection, place), 1});
}

void PartArguments::set_times(const std::string& value) {
  if (with_times_ == stiffness_.size())
    throw UsageError(
        fmt::format("--times {}: no --stiffen stands before it, to which it could belong", value));
  const double times = parse_number(value, "--times");
  if (times <= 0 || times > 1e6)
    throw UsageError(fmt::format("--times {}: allowed: a number above 0, at most 1e6", value));
  stiffness_[with_times_++].times = times;
}

}  // namespace supple
