#include "io/scene/nearest_name.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace supple {
namespace {

constexpr std::size_t longest_name = 64;  // nothing longer is a misspelt name

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (lower(a[i]) == lower(b[j]) ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest_name(std::string_view wanted, std::span<const std::string_view> names) {
  if (wanted.size() > longest_name) return "";
  std::string_view nearest;
  std::size_t least = longest_name;
  for (std::string_view name : names) {
    const std::size_t distance = edit_distance(wanted, name);
    const std::size_t longer = std::max(wanted.size(), name.size());
    const bool is_near = 2 * distance <= longer + 1 && distance < longer;
    if (!is_near || distance >= least) continue;
    least = distance;
    nearest = name;
  }
  return std::string(nearest);
}

}  // namespace supple
