#include "modeler/cli/picture_arguments.h"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "io/errors.h"
#include "modeler/cli/values.h"

namespace supple {
namespace {

constexpr int smallest_side = 16, greatest_side = 8192;  // [px]

}  // namespace

void PictureArguments::declare(CommandLine& line) {
  line.begin_group("Picture");
  line.option("--camera",
              {"AZ,EL[,ZOOM]", "degrees about the up axis and above the ground (30,15,1)"},
              [this](const std::string& value) { set_camera(value); });
  line.option("--up", {"y|z", "the shape's upward axis (y)"},
              [this](const std::string& value) { set_up(value); });
  line.option("--size", {"WxH", "pixels (1280x720)"},
              [this](const std::string& value) { set_size(value); });
}

void PictureArguments::set_camera(const std::string& value) {
  const std::string form = "AZ,EL or AZ,EL,ZOOM (30,15,1.5)";
  const std::vector<double> numbers = parse_numbers(value, "--camera", form);
  if (numbers.size() < 2 || numbers.size() > 3)
    throw UsageError(fmt::format("--camera {}: allowed: {}", value, form));
  if (std::abs(numbers[1]) > 90)
    throw UsageError(fmt::format("--camera {}: the elevation is allowed from -90 to 90", value));
  if (numbers.size() == 3 && numbers[2] <= 0)
    throw UsageError(fmt::format("--camera {}: the zoom is allowed above 0", value));
  options_.camera.azimuth_deg = numbers[0];
  options_.camera.elevation_deg = numbers[1];
  if (numbers.size() == 3) options_.camera.zoom = numbers[2];
}

void PictureArguments::set_up(const std::string& value) {
  if (value != "y" && value != "z") throw UsageError(fmt::format("--up {}: allowed: y, z", value));
  options_.camera.up = value == "y" ? Vec3(Vec3::UnitY()) : Vec3(Vec3::UnitZ());
}

void PictureArguments::set_size(const std::string& value) {
  const std::size_t cross = value.find('x');
  if (cross == std::string::npos)
    throw UsageError(fmt::format("--size {}: allowed: WIDTHxHEIGHT in pixels (1280x720)", value));
  options_.width = parse_count(value.substr(0, cross), "--size", smallest_side, greatest_side);
  options_.height = parse_count(value.substr(cross + 1), "--size", smallest_side, greatest_side);
}

void check_picture_name(const std::string& path, std::string_view option) {
  if (path != "-" && std::filesystem::path(path).extension() != ".png")
    throw UsageError(fmt::format("{} {}: a picture's name ends in .png", option, path));
}

}  // namespace supple
