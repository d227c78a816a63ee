#include "io/gltf/gltf_object.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "io/errors.h"

namespace supple {

using nlohmann::json;

namespace {

bool is_whole(const json& value) {
  constexpr std::uint64_t largest = std::uint64_t{1} << 53;
  return value.is_number_unsigned() && value.get<std::uint64_t>() <= largest;
}

}  // namespace

GltfObject::GltfObject(const json& value, std::string path)
    : value_(&value), path_(std::move(path)) {
  if (!value.is_object()) fail("an object is expected");
}

std::size_t GltfObject::whole(std::string_view key) const {
  const json* member = find(key);
  if (!member || !is_whole(*member)) fail_member(key, "a whole number from 0");
  return member->get<std::size_t>();
}

std::size_t GltfObject::whole(std::string_view key, std::size_t fallback) const {
  return find(key) ? whole(key) : fallback;
}

std::size_t GltfObject::index(std::string_view key, std::size_t count,
                              std::string_view what) const {
  const std::size_t value = whole(key);
  if (value >= count)
    fail(fmt::format("{} {} does not exist, the file has {} {}", key, value, count, what));
  return value;
}

std::string GltfObject::text(std::string_view key, std::string_view fallback) const {
  const json* member = find(key);
  if (!member) return std::string(fallback);
  if (!member->is_string()) fail_member(key, "a text");
  return member->get<std::string>();
}

bool GltfObject::flag(std::string_view key) const {
  const json* member = find(key);
  if (!member) return false;
  if (!member->is_boolean()) fail_member(key, "true or false");
  return member->get<bool>();
}

std::vector<double> GltfObject::numbers(std::string_view key, std::vector<double> fallback) const {
  const json* member = find(key);
  if (!member) return fallback;
  const std::string expected = fmt::format("an array of {} finite numbers", fallback.size());
  if (!member->is_array() || member->size() != fallback.size()) fail_member(key, expected);
  for (std::size_t i = 0; i < fallback.size(); ++i) {
    const json& number = (*member)[i];
    if (!number.is_number() || !std::isfinite(number.get<double>())) fail_member(key, expected);
    fallback[i] = number.get<double>();
  }
  return fallback;
}

std::vector<std::size_t> GltfObject::indices(std::string_view key, std::size_t count) const {
  const json* member = find(key);
  if (!member) return {};
  const std::string expected = fmt::format("an array of whole numbers below {}", count);
  if (!member->is_array()) fail_member(key, expected);
  std::vector<std::size_t> values;
  for (const json& number : *member) {
    if (!is_whole(number) || number.get<std::size_t>() >= count) fail_member(key, expected);
    values.push_back(number.get<std::size_t>());
  }
  return values;
}

GltfObject GltfObject::object(std::string_view key) const {
  const json* member = find(key);
  if (!member) fail_member(key, "an object");
  return {*member, below(key)};
}

std::size_t GltfObject::size(std::string_view key) const {
  const json* member = find(key);
  if (!member) return 0;
  if (!member->is_array()) fail_member(key, "an array");
  return member->size();
}

GltfObject GltfObject::item(std::string_view key, std::size_t index) const {
  if (index >= size(key)) fail(fmt::format("{} has no item {}", key, index));
  return {(*find(key))[index], fmt::format("{}[{}]", below(key), index)};
}

void GltfObject::fail(std::string_view message) const {
  std::string_view place = path_;
  while (place.ends_with(' ') || place.ends_with(':')) place.remove_suffix(1);
  throw InputError(fmt::format("{}: {}", place, message));
}

std::string GltfObject::below(std::string_view key) const {
  return fmt::format("{}{}{}", path_, path_.ends_with(' ') ? "" : ".", key);
}

const json* GltfObject::find(std::string_view key) const {
  const auto member = value_->find(key);
  return member == value_->end() ? nullptr : &*member;
}

void GltfObject::fail_member(std::string_view key, std::string_view expected) const {
  fail(fmt::format("{}: {} is expected", key, expected));
}

}  // namespace supple
