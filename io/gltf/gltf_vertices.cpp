#include "io/gltf/gltf_vertices.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "io/gltf/gltf_color.h"

namespace supple {
namespace {

using Eigen::Affine3d;

/// Of four joints a vertex; a small file must not have one accessor read again and again.
constexpr int most_joint_sets = 4;

/// Where each vertex of a primitive goes: one transform for all, or a mean of joints' for each.
class Placement {
 public:
  Placement(const GltfDocument& document, const PlacedMesh& placed, const GltfObject& attributes,
            Index vertices)
      : placed_(placed) {
    for (int set = 0; placed.joints && set < most_joint_sets; ++set) {
      const std::string joints = fmt::format("JOINTS_{}", set),
                        weights = fmt::format("WEIGHTS_{}", set);
      if (!attributes.has(joints) || !attributes.has(weights)) break;
      joints_.push_back(
          read_accessor(document, accessor_of(document, attributes, joints), {4}, joints));
      weights_.push_back(
          read_accessor(document, accessor_of(document, attributes, weights), {4}, weights));
      check(attributes, vertices);
    }
  }

  Affine3d at(Index vertex) const {
    if (joints_.empty()) return placed_.transform;
    Affine3d sum;
    sum.affine().setZero();
    double weight = 0;
    for (std::size_t set = 0; set < joints_.size(); ++set)
      for (int i = 0; i < 4; ++i) {
        const auto joint = static_cast<std::size_t>(joints_[set](vertex, i));
        sum.affine() += weights_[set](vertex, i) * (*placed_.joints)[joint].affine();
        weight += weights_[set](vertex, i);
      }
    if (weight <= 0) return placed_.transform;
    sum.affine() /= weight;
    return sum;
  }

 private:
  void check(const GltfObject& attributes, Index vertices) const {
    const double joints = static_cast<double>(placed_.joints->size());
    if (joints_.back().rows() != vertices || weights_.back().rows() != vertices)
      attributes.fail("joints, weights and positions differ in number");
    if (vertices > 0 && (joints_.back().minCoeff() < 0 || joints_.back().maxCoeff() >= joints))
      attributes.fail(fmt::format("a joint does not exist, the skin has {}", joints));
    if (vertices > 0 && weights_.back().minCoeff() < 0)
      attributes.fail("a joint's weight is negative");
  }

  const PlacedMesh& placed_;
  std::vector<AccessorValues> joints_, weights_;
};

/// A normal carried by the transform: cof(F) n, of unit length.
Vec3 turned(const Affine3d& transform, const Vec3& normal) {
  const Mat3 F = transform.linear();
  Mat3 cofactor;
  cofactor << F.col(1).cross(F.col(2)), F.col(2).cross(F.col(0)), F.col(0).cross(F.col(1));
  if (F.determinant() < 0) cofactor = -cofactor;
  return (cofactor * normal).stableNormalized();
}

template <int Columns>
void take_values(const GltfColumn& column, Attribute<Columns>& attribute) {
  using Values = Eigen::Matrix<double, Eigen::Dynamic, Columns, Eigen::RowMajor>;
  const Index rows = static_cast<Index>(column.values.size()) / Columns;
  attribute.values = Eigen::Map<const Values>(column.values.data(), rows, Columns);
}

}  // namespace

int GltfVertices::append(const PlacedMesh& placed, const GltfObject& attributes) {
  const AccessorValues positions =
      read_accessor(document_, accessor_of(document_, attributes, "POSITION"), {3}, "position");
  const Index count = positions.rows();
  const Placement placement(document_, placed, attributes, count);
  const AccessorValues normals = values_of(attributes, "NORMAL", {3}, count);
  const Index before = this->count();
  if (normals.rows() > 0) normals_.begin(before);
  for (Index i = 0; i < count; ++i) {
    const Affine3d transform = placement.at(i);
    const Vec3 x = transform * Vec3(positions.row(i).transpose());
    if (!x.allFinite()) attributes.fail(fmt::format("position {} is not finite in its place", i));
    positions_.insert(positions_.end(), x.begin(), x.end());
    if (normals.rows() > 0) normals_.append(turned(transform, normals.row(i).transpose()));
  }
  if (normals.rows() == 0) normals_.append_missing(count);
  append_texcoords(values_of(attributes, "TEXCOORD_0", {2}, count), before, count);
  append_colors(values_of(attributes, "COLOR_0", {3, 4}, count), before, count);
  return static_cast<int>(count);
}

void GltfVertices::append_texcoords(const AccessorValues& values, Index before, Index count) {
  if (values.rows() == 0) return texcoords_.append_missing(count);
  texcoords_.begin(before);
  for (Index i = 0; i < count; ++i) texcoords_.append(std::array{values(i, 0), 1 - values(i, 1)});
}

void GltfVertices::append_colors(const AccessorValues& values, Index before, Index count) {
  if (values.rows() == 0) return colors_.append_missing(count);
  colors_.begin(before);
  if (count > 0) bright_ += (values.rowwise().maxCoeff().array() > 1).count();
  for (Index i = 0; i < count; ++i)
    colors_.append(std::array{srgb_from_linear(values(i, 0)), srgb_from_linear(values(i, 1)),
                              srgb_from_linear(values(i, 2)),
                              values.cols() == 4 ? std::clamp(values(i, 3), 0.0, 1.0) : 1.0});
}

/// Of an attribute that need not be there; no rows where it is not.
AccessorValues GltfVertices::values_of(const GltfObject& attributes, std::string_view name,
                                       std::initializer_list<int> columns, Index count) const {
  if (!attributes.has(name)) return {};
  AccessorValues values =
      read_accessor(document_, accessor_of(document_, attributes, name), columns, name);
  if (values.rows() != count)
    attributes.fail(fmt::format("{} {} for {} positions", values.rows(), name, count));
  return values;
}

void GltfVertices::take(Mesh& mesh) {
  mesh.positions = Eigen::Map<const Points>(positions_.data(), count(), 3);
  if (normals_.missing == 0) {
    take_values(normals_, mesh.normals);
  } else if (normals_.missing < count()) {
    mesh.notes.push_back(
        fmt::format("left out: normals, since {} vertices have none", normals_.missing));
  }
  take_values(texcoords_, mesh.texcoords);
  take_values(colors_, mesh.colors);
  const auto note_filled = [&](const GltfColumn& column, std::string_view what) {
    if (column.missing > 0 && column.missing < count())
      mesh.notes.push_back(fmt::format("{} vertices have no {}", column.missing, what));
  };
  note_filled(texcoords_, "texture coordinates: now (0, 0)");
  note_filled(colors_, "color: now white");
  if (bright_ > 0)
    mesh.notes.push_back(fmt::format("{} colors are brighter than 1: now 1", bright_));
}

}  // namespace supple
