#include "io/scene/scene_hash.h"

#include <type_traits>

#include <fmt/format.h>

namespace supple {
namespace {

template <class T>
concept Struct = requires(T& value) {
  T::describe(value, [](std::string_view, auto&, const Described&) {});
};

/// Writes each value with its name.
class SceneText {
 public:
  explicit SceneText(std::string& text) : text_(text) {}

  template <class T>
  void operator()(std::string_view name, const T& value, const Described&) {
    text_ += name;
    text_ += '=';
    add(value);
    text_ += '\n';
  }

 private:
  template <class T>
  requires std::is_arithmetic_v<T>
  void add(T value) { text_ += fmt::format("{}", value); }

  template <class E>
  requires std::is_enum_v<E>
  void add(E value) { text_ += enum_name(value); }

  void add(const std::string& value) { text_ += fmt::format("{}:{}", value.size(), value); }
  void add(const Length& length) { text_ += to_string(length); }
  void add(const Selection& selection) { add(selection.text); }
  void add(const NamedFile& file) { add(file.path); }
  void add(const Vec3& v) { text_ += fmt::format("{} {} {}", v[0], v[1], v[2]); }

  void add(const LengthVector& vector) {
    for (const Length& length : vector) text_ += to_string(length) + " ";
  }

  template <class T>
  void add(const std::optional<T>& value) {
    if (value) add(*value);
  }

  template <class T>
  void add(const std::vector<T>& values) {
    for (const T& value : values) add(value);
  }

  template <Struct T>
  void add(const T& value) {
    text_ += "{\n";
    T::describe(value, SceneText(text_));
    text_ += '}';
  }

  std::string& text_;
};

}  // namespace

std::uint64_t hash_bytes(std::span<const std::byte> bytes, std::uint64_t before) {
  constexpr std::uint64_t prime = 0x100000001b3;
  for (const std::byte byte : bytes) before = (before ^ static_cast<std::uint64_t>(byte)) * prime;
  return before;
}

std::uint64_t scene_hash(const Scene& scene) {
  std::string text;
  Scene::describe(scene, SceneText(text));
  return hash_bytes(std::as_bytes(std::span(text)));
}

}  // namespace supple
