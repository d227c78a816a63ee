#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace supple {

/// An object of a glTF file's JSON that knows its path ("x.glb: accessors[3]") for messages.
/// Errors (everywhere): InputError with the path where a member is missing or of another kind.
class GltfObject {
 public:
  GltfObject(const nlohmann::json& value, std::string path);

  const nlohmann::json& value() const { return *value_; }
  const std::string& path() const { return path_; }
  bool has(std::string_view key) const { return value_->contains(key); }

  /// A whole number from 0 that a double holds exactly.
  std::size_t whole(std::string_view key) const;
  std::size_t whole(std::string_view key, std::size_t fallback) const;
  /// The same below `count`: an index into the list of that many `what`.
  std::size_t index(std::string_view key, std::size_t count, std::string_view what) const;
  std::string text(std::string_view key, std::string_view fallback) const;
  bool flag(std::string_view key) const;
  /// Finite numbers, as many as `fallback` has, which is the answer where there is no such member.
  std::vector<double> numbers(std::string_view key, std::vector<double> fallback) const;
  /// Whole numbers below `count`.
  std::vector<std::size_t> indices(std::string_view key, std::size_t count) const;

  GltfObject object(std::string_view key) const;
  /// Length of an array; 0 where there is no such member.
  std::size_t size(std::string_view key) const;
  /// Item of an array of objects.
  GltfObject item(std::string_view key, std::size_t index) const;

  [[noreturn]] void fail(std::string_view message) const;

 private:
  std::string below(std::string_view key) const;  ///< path of a member
  const nlohmann::json* find(std::string_view key) const;
  [[noreturn]] void fail_member(std::string_view key, std::string_view expected) const;

  const nlohmann::json* value_;
  std::string path_;
};

}  // namespace supple
