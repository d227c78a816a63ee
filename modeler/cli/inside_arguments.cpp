#include "modeler/cli/inside_arguments.h"

#include <algorithm>

#include <fmt/format.h>

#include "io/errors.h"
#include "io/scene/complaint.h"
#include "modeler/cli/values.h"

namespace supple {
namespace {

constexpr int most_particles = 1000000;

}  // namespace

void InsideArguments::declare(CommandLine& line) {
  line.begin_group("Inside");
  line.option("--particles", {"N", "particles that a pose would use (default 200)"},
              [this](const std::string& value) {
                spec_.particles = parse_count(value, "--particles", 1, most_particles);
              });
  line.option("--spacing", {"LENGTH", "their distance, instead of their number (3%, 0.01)"},
              [this](const std::string& value) {
                spec_.spacing = parse_length(value, {"command line"}, "--spacing");
                if (!(spec_.spacing->value > 0))
                  throw UsageError(fmt::format("--spacing {}: allowed: above 0", value));
              });
  line.option("--show", {"particles|supports|cells|slice", "what of the inside the picture shows"},
              [this](const std::string& value) { show(value); });
}

void InsideArguments::show(const std::string& value) {
  std::vector<std::string_view> names;
  for (const auto& [inside, name] : enum_names(Inside{})) {
    names.push_back(name);
    if (name == value) shown_ = inside;
  }
  if (!shown_)
    throw UsageError(
        fmt::format("--show {}: not known{}", in_quotes(value), allowed_names(value, names)));
}

ShapeSpec InsideArguments::spec() const {
  if (spec_.particles && spec_.spacing)
    throw UsageError("--particles and --spacing: only one of the two");
  return spec_;
}

}  // namespace supple
