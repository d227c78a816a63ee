#include "io/mesh/plain_name.h"

#include <algorithm>

namespace supple {
namespace {

bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

}  // namespace

std::string plain_name(std::string_view name) {
  std::string plain(name);
  std::replace_if(plain.begin(), plain.end(), is_control, ' ');
  plain.erase(0, plain.find_first_not_of(' '));
  plain.erase(plain.find_last_not_of(' ') + 1);
  for (std::size_t i = 0; i < plain.size(); ++i)
    if (plain[i] == '#' && (i == 0 || plain[i - 1] == ' ')) plain[i] = '_';
  if (plain.ends_with('\\')) plain.back() = '_';
  return plain;
}

bool names_are_plain(const Mesh& mesh) {
  const auto is_plain = [](const std::string& name) { return plain_name(name) == name; };
  return std::all_of(mesh.tags.begin(), mesh.tags.end(),
                     [&](const FaceTag& tag) { return is_plain(tag.name); }) &&
         std::all_of(mesh.material_libraries.begin(), mesh.material_libraries.end(), is_plain);
}

}  // namespace supple
