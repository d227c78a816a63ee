#include "io/gltf/gltf_accessor.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

namespace supple {
namespace {

/// The kinds of numbers, as OpenGL numbers them.
enum ComponentType : std::size_t {
  int8 = 5120,
  uint8 = 5121,
  int16 = 5122,
  uint16 = 5123,
  uint32 = 5125,
  float32 = 5126
};

std::size_t component_bytes(const GltfObject& accessor, std::size_t type) {
  switch (type) {
    case int8:
    case uint8:
      return 1;
    case int16:
    case uint16:
      return 2;
    case uint32:
    case float32:
      return 4;
  }
  accessor.fail(fmt::format("componentType {} is none of glTF's", type));
}

template <class Number>
double number_at(const char* bytes, bool normalized) {
  Number number;
  std::memcpy(&number, bytes, sizeof(number));
  const auto value = static_cast<double>(number);
  if (!normalized) return value;
  return std::max(value / static_cast<double>(std::numeric_limits<Number>::max()), -1.0);
}

double component_at(const char* bytes, std::size_t type, bool normalized) {
  switch (type) {
    case int8:
      return number_at<std::int8_t>(bytes, normalized);
    case uint8:
      return number_at<std::uint8_t>(bytes, normalized);
    case int16:
      return number_at<std::int16_t>(bytes, normalized);
    case uint16:
      return number_at<std::uint16_t>(bytes, normalized);
    case uint32:
      return number_at<std::uint32_t>(bytes, normalized);
    default:
      return number_at<float>(bytes, false);
  }
}

int columns_of(const GltfObject& accessor) {
  constexpr std::pair<std::string_view, int> types[] = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
  const std::string type = accessor.text("type", "");
  for (const auto& [name, columns] : types)
    if (type == name) return columns;
  accessor.fail(fmt::format("type \"{}\" is not one that is read here", type.substr(0, 40)));
}

/// Elements of a buffer view.
struct Elements {
  std::string_view bytes;
  std::size_t stride, type;
  bool normalized;
};

/// `count` elements from `source`'s byteOffset on; `source` is the accessor or a part of it.
Elements find_elements(const GltfDocument& document, const GltfObject& source, std::size_t type,
                       std::size_t columns, std::size_t count) {
  const GltfObject root = document.root();
  const std::size_t view = source.index("bufferView", root.size("bufferViews"), "bufferViews");
  const std::size_t size = columns * component_bytes(source, type);
  const std::size_t stride = root.item("bufferViews", view).whole("byteStride", size);
  const std::size_t offset = source.whole("byteOffset", 0);
  std::string_view bytes = view_bytes(document, view);
  if (stride < size || stride > 252)
    source.fail(fmt::format("byteStride {} is outside {} to 252", stride, size));
  if (offset > bytes.size() || (count > 0 && (bytes.size() - offset < size ||
                                              (bytes.size() - offset - size) / stride < count - 1)))
    source.fail(fmt::format("{} elements from byte {} on do not fit into bufferView {} of {} bytes",
                            count, offset, view, bytes.size()));
  return {bytes.substr(offset), stride, type, false};
}

double value_at(const Elements& elements, std::size_t row, std::size_t column) {
  const std::size_t width = elements.type <= uint8 ? 1 : elements.type <= uint16 ? 2 : 4;
  return component_at(elements.bytes.data() + row * elements.stride + column * width, elements.type,
                      elements.normalized);
}

class AccessorReader {
 public:
  AccessorReader(const GltfDocument& document, std::size_t index)
      : document_(document),
        accessor_(document.root().item("accessors", index)),
        count_(accessor_.whole("count")),
        columns_(static_cast<std::size_t>(columns_of(accessor_))),
        type_(accessor_.whole("componentType")),
        normalized_(accessor_.flag("normalized")) {
    // Without a view, zeros: still no more of them than the file's bytes could hold.
    if (count_ > document.size() / columns_)
      accessor_.fail(fmt::format("count {} is more than the buffers' {} bytes can hold", count_,
                                 document.size()));
    component_bytes(accessor_, type_);
  }

  const GltfObject& accessor() const { return accessor_; }
  int columns() const { return static_cast<int>(columns_); }
  bool holds_indices() const {
    return columns_ == 1 && (type_ == uint8 || type_ == uint16 || type_ == uint32);
  }

  AccessorValues read() const {
    AccessorValues values =
        AccessorValues::Zero(static_cast<Index>(count_), static_cast<Index>(columns_));
    if (accessor_.has("bufferView")) {
      const Elements elements = elements_of(accessor_, count_);
      for (std::size_t row = 0; row < count_; ++row) read_row(elements, row, row, values);
    }
    if (accessor_.has("sparse")) read_sparse(values);
    return values;
  }

 private:
  using Index = Eigen::Index;

  Elements elements_of(const GltfObject& source, std::size_t count) const {
    Elements elements = find_elements(document_, source, type_, columns_, count);
    elements.normalized = normalized_;
    return elements;
  }

  void read_row(const Elements& elements, std::size_t from, std::size_t to,
                AccessorValues& values) const {
    for (std::size_t column = 0; column < columns_; ++column)
      values(static_cast<Index>(to), static_cast<Index>(column)) = value_at(elements, from, column);
  }

  void read_sparse(AccessorValues& values) const {
    const GltfObject sparse = accessor_.object("sparse");
    const std::size_t count = sparse.whole("count");
    if (count > count_) sparse.fail(fmt::format("count {} of {} elements", count, count_));
    const GltfObject places = sparse.object("indices");
    const Elements indices =
        find_elements(document_, places, places.whole("componentType"), 1, count);
    const Elements changes = elements_of(sparse.object("values"), count);
    for (std::size_t i = 0; i < count; ++i) {
      const double row = value_at(indices, i, 0);
      if (!(row >= 0 && row < static_cast<double>(count_)))
        sparse.fail(fmt::format("element {} does not exist, the accessor has {}", row, count_));
      read_row(changes, i, static_cast<std::size_t>(row), values);
    }
  }

  const GltfDocument& document_;
  GltfObject accessor_;
  std::size_t count_, columns_, type_;
  bool normalized_;
};

}  // namespace

std::size_t accessor_of(const GltfDocument& document, const GltfObject& owner,
                        std::string_view name) {
  return owner.index(name, document.root().size("accessors"), "accessors");
}

AccessorValues read_accessor(const GltfDocument& document, std::size_t index,
                             std::initializer_list<int> columns, std::string_view what) {
  const AccessorReader reader(document, index);
  if (std::find(columns.begin(), columns.end(), reader.columns()) == columns.end())
    reader.accessor().fail(
        fmt::format("{}: {} numbers an element are not right", what, reader.columns()));
  AccessorValues values = reader.read();
  for (Eigen::Index row = 0; row < values.rows(); ++row)
    if (!values.row(row).allFinite())
      reader.accessor().fail(
          fmt::format("{} {} (counted from 0) is not finite: {}", what, row,
                      fmt::join(values.row(row).begin(), values.row(row).end(), " ")));
  return values;
}

std::vector<int> read_indices(const GltfDocument& document, std::size_t index, std::size_t count) {
  const AccessorReader reader(document, index);
  if (!reader.holds_indices())
    reader.accessor().fail("indices: unsigned whole numbers are expected");
  const AccessorValues values = reader.read();
  std::vector<int> indices(static_cast<std::size_t>(values.rows()));
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    if (values(row, 0) >= static_cast<double>(count))
      reader.accessor().fail(
          fmt::format("index {} of element {}: there are {} vertices", values(row, 0), row, count));
    indices[static_cast<std::size_t>(row)] = static_cast<int>(values(row, 0));
  }
  return indices;
}

}  // namespace supple
