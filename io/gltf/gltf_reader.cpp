#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "io/gltf/gltf_accessor.h"
#include "io/gltf/gltf_color.h"
#include "io/gltf/gltf_document.h"
#include "io/gltf/gltf_formats.h"
#include "io/gltf/gltf_materials.h"
#include "io/gltf/gltf_nodes.h"
#include "io/mesh/mesh_checks.h"

namespace supple {
namespace {

using Eigen::Affine3d;

enum Mode : std::size_t { points = 0, triangles = 4, strip = 5, fan = 6 };

/// Nodes may show a mesh many times; a small file must not become more than this.
constexpr std::size_t most_repeated = 10'000'000;

/// Vertices that follow each other.
struct Block {
  int first, count;
};

/// Values of the vertices, of as many numbers as `fallback`, which stands where there is none.
/// Nothing is kept as long as all are missing.
struct Column {
  std::vector<double> fallback, values{};
  Index missing = 0;

  /// Before the first vertex that has a value, behind `before` others.
  void begin(Index before) {
    if (!values.empty()) return;
    for (Index i = 0; i < before; ++i) append(fallback);
  }
  template <class Values>
  void append(const Values& more) {
    values.insert(values.end(), more.begin(), more.end());
  }
  void append_missing(Index count) {
    missing += count;
    for (Index i = 0; i < count && !values.empty(); ++i) append(fallback);
  }
};

template <int Columns>
void take_values(const Column& column, Attribute<Columns>& attribute) {
  using Values = Eigen::Matrix<double, Eigen::Dynamic, Columns, Eigen::RowMajor>;
  const Index rows = static_cast<Index>(column.values.size()) / Columns;
  attribute.values = Eigen::Map<const Values>(column.values.data(), rows, Columns);
}

/// Where each vertex of a primitive goes: one transform for all, or a mean of joints' for each.
class Placement {
 public:
  Placement(const GltfDocument& document, const PlacedMesh& placed, const GltfObject& attributes,
            Index vertices)
      : placed_(placed) {
    const std::size_t accessors = document.root().size("accessors");
    for (int set = 0; !placed.joints.empty(); ++set) {
      const std::string joints = fmt::format("JOINTS_{}", set),
                        weights = fmt::format("WEIGHTS_{}", set);
      if (!attributes.has(joints) || !attributes.has(weights)) break;
      joints_.push_back(
          read_accessor(document, attributes.index(joints, accessors, "accessors"), {4}, joints));
      weights_.push_back(
          read_accessor(document, attributes.index(weights, accessors, "accessors"), {4}, weights));
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
        sum.affine() += weights_[set](vertex, i) * placed_.joints[joint].affine();
        weight += weights_[set](vertex, i);
      }
    if (weight <= 0) return placed_.transform;
    sum.affine() /= weight;
    return sum;
  }

 private:
  void check(const GltfObject& attributes, Index vertices) const {
    const double joints = static_cast<double>(placed_.joints.size());
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

class GltfReader {
 public:
  explicit GltfReader(const FileBytes& file)
      : file_(file), document_(open_gltf(file)), root_(document_.root()) {}

  Mesh read() {
    mesh_.notes = document_.notes;
    mesh_.gltf_materials = take_materials(document_, mesh_.notes);
    const std::vector<PlacedMesh> placed = placed_meshes(document_);
    check_size(placed);
    for (const PlacedMesh& part : placed) read_faces(part);
    if (mesh_.face_count() == 0)
      for (const PlacedMesh& part : placed) read_points(part);
    take_vertices();
    note_what_is_kept(placed);
    finish_mesh(mesh_, file_);
    return std::move(mesh_);
  }

 private:
  void read_faces(const PlacedMesh& placed) {
    blocks_.clear();
    bool named = false;
    const GltfObject mesh = root_.item("meshes", placed.mesh);
    for (std::size_t i = 0; i < mesh.size("primitives"); ++i) {
      const GltfObject primitive = mesh.item("primitives", i);
      const std::size_t mode = primitive.whole("mode", triangles);
      if (mode > fan) primitive.fail(fmt::format("mode {} does not exist", mode));
      if (mode == points) ++point_sets_;
      if (mode > points && mode < triangles) ++line_sets_;
      if (mode < triangles) continue;
      if (!named) tag_object(placed);
      named = true;
      tag_material(primitive);
      add_triangles(placed, primitive, mode);
    }
  }

  void read_points(const PlacedMesh& placed) {
    blocks_.clear();
    const GltfObject mesh = root_.item("meshes", placed.mesh);
    for (std::size_t i = 0; i < mesh.size("primitives"); ++i) {
      const GltfObject primitive = mesh.item("primitives", i);
      if (primitive.whole("mode", triangles) == points) add_vertices(placed, primitive);
    }
    point_sets_ = 0;
  }

  void tag_object(const PlacedMesh& placed) {
    const std::string name = placed.name.empty() ? fmt::format("object {}", objects_) : placed.name;
    mesh_.tags.push_back({FaceTag::Kind::object, name, mesh_.face_count()});
    ++objects_;
  }

  /// The empty name stands for no material, which needs no tag before the first one.
  void tag_material(const GltfObject& primitive) {
    std::string name;
    if (primitive.has("material"))
      name = mesh_.gltf_materials
                 ->names[primitive.index("material", root_.size("materials"), "materials")];
    if (name == material_) return;
    mesh_.tags.push_back({FaceTag::Kind::material, name, mesh_.face_count()});
    material_ = name;
  }

  void add_triangles(const PlacedMesh& placed, const GltfObject& primitive, std::size_t mode) {
    const auto [first, count] = add_vertices(placed, primitive);
    std::vector<int> corners;
    if (primitive.has("indices")) {
      corners = read_indices(document_, accessor_of(primitive, "indices"),
                             static_cast<std::size_t>(count));
    } else {
      for (int i = 0; i < count; ++i) corners.push_back(i);
    }
    const bool mirrored = placed.joints.empty() && placed.transform.linear().determinant() < 0;
    const std::size_t step = mode == triangles ? 3 : 1;
    if (mode == triangles && corners.size() % 3 != 0)
      primitive.fail(fmt::format("{} corners are no triangles", corners.size()));
    for (std::size_t i = 0; i + 2 < corners.size(); i += step) {
      int a = corners[mode == fan ? 0 : i], b = corners[i + 1], c = corners[i + 2];
      // A strip's joints are triangles without area.
      if (mode != triangles && (a == b || b == c || c == a)) continue;
      if ((mode == strip && i % 2 == 1) != mirrored) std::swap(b, c);
      mesh_.face_vertices.insert(mesh_.face_vertices.end(), {first + a, first + b, first + c});
      mesh_.face_starts.push_back(static_cast<int>(mesh_.face_vertices.size()));
    }
  }

  /// Reads the primitive's vertices, once where several share them.
  Block add_vertices(const PlacedMesh& placed, const GltfObject& primitive) {
    const GltfObject attributes = primitive.object("attributes");
    std::vector<std::size_t> key;
    for (const char* name :
         {"POSITION", "NORMAL", "TEXCOORD_0", "COLOR_0", "JOINTS_0", "WEIGHTS_0"})
      key.push_back(attributes.has(name) ? accessor_of(attributes, name) : -1);
    const auto [block, is_new] = blocks_.try_emplace(key, Block{vertex_count(), 0});
    if (is_new) {
      block->second.count = read_vertices(placed, attributes);
      morph_targets_ += primitive.size("targets");
      for (const auto& attribute : attributes.value().items()) note_attribute(attribute.key());
    }
    return block->second;
  }

  int read_vertices(const PlacedMesh& placed, const GltfObject& attributes) {
    const AccessorValues positions =
        read_accessor(document_, accessor_of(attributes, "POSITION"), {3}, "position");
    const Index count = positions.rows();
    const Placement placement(document_, placed, attributes, count);
    const AccessorValues normals = values_of(attributes, "NORMAL", {3}, count);
    const Index before = vertex_count();
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

  static Vec3 turned(const Affine3d& transform, const Vec3& normal) {
    const Mat3 F = transform.linear();
    Mat3 cofactor;
    cofactor << F.col(1).cross(F.col(2)), F.col(2).cross(F.col(0)), F.col(0).cross(F.col(1));
    if (F.determinant() < 0) cofactor = -cofactor;
    return (cofactor * normal).stableNormalized();
  }

  void append_texcoords(const AccessorValues& values, Index before, Index count) {
    if (values.rows() == 0) return texcoords_.append_missing(count);
    texcoords_.begin(before);
    for (Index i = 0; i < count; ++i) texcoords_.append(std::array{values(i, 0), 1 - values(i, 1)});
  }

  void append_colors(const AccessorValues& values, Index before, Index count) {
    if (values.rows() == 0) return colors_.append_missing(count);
    colors_.begin(before);
    for (Index i = 0; i < count; ++i)
      colors_.append(std::array{srgb_from_linear(values(i, 0)), srgb_from_linear(values(i, 1)),
                                srgb_from_linear(values(i, 2)),
                                values.cols() == 4 ? std::clamp(values(i, 3), 0.0, 1.0) : 1.0});
  }

  std::size_t accessor_of(const GltfObject& attributes, std::string_view name) const {
    return attributes.index(name, root_.size("accessors"), "accessors");
  }

  /// Of an attribute that need not be there; no rows where it is not.
  AccessorValues values_of(const GltfObject& attributes, std::string_view name,
                           std::initializer_list<int> columns, Index count) const {
    if (!attributes.has(name)) return {};
    AccessorValues values = read_accessor(document_, accessor_of(attributes, name), columns, name);
    if (values.rows() != count)
      attributes.fail(fmt::format("{} {} for {} positions", values.rows(), name, count));
    return values;
  }

  int vertex_count() const { return static_cast<int>(positions_.size() / 3); }

  /// Before anything is read: vertices and corners, counted where nodes repeat them.
  void check_size(const std::vector<PlacedMesh>& placed) const {
    const std::size_t most = std::min<std::size_t>(std::max(document_.size(), most_repeated),
                                                   std::numeric_limits<int>::max() / 3);
    std::vector<std::size_t> sizes;
    for (std::size_t mesh = 0; mesh < root_.size("meshes"); ++mesh)
      sizes.push_back(mesh_size(mesh));
    std::size_t total = 0;
    for (const PlacedMesh& part : placed) {
      total += sizes[part.mesh];
      if (total > most)
        root_.fail(fmt::format(
            "its nodes repeat meshes until there are more than {} vertices and corners", most));
    }
  }

  std::size_t mesh_size(std::size_t index) const {
    const GltfObject mesh = root_.item("meshes", index);
    std::size_t size = 0;
    const auto add = [&](const GltfObject& owner, std::string_view key) {
      if (owner.has(key))
        size += std::min(root_.item("accessors", accessor_of(owner, key)).whole("count"),
                         document_.size());
    };
    for (std::size_t i = 0; i < mesh.size("primitives"); ++i) {
      const GltfObject primitive = mesh.item("primitives", i);
      add(primitive, "indices");
      add(primitive.object("attributes"), "POSITION");
    }
    return size;
  }

  void take_vertices() {
    mesh_.positions = Eigen::Map<const Points>(positions_.data(), vertex_count(), 3);
    if (normals_.missing == 0) {
      take_values(normals_, mesh_.normals);
    } else if (normals_.missing < vertex_count()) {
      mesh_.notes.push_back(
          fmt::format("left out: normals, since {} vertices have none", normals_.missing));
    }
    take_values(texcoords_, mesh_.texcoords);
    take_values(colors_, mesh_.colors);
  }

  void note_attribute(const std::string& name) {
    for (const char* known : {"POSITION", "NORMAL", "TEXCOORD_0", "COLOR_0"})
      if (name == known) return;
    if (name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_")) return;
    ++attributes_left_out_[name];
  }

  void note_what_is_kept(const std::vector<PlacedMesh>& placed) {
    if (mesh_.gltf_materials)
      mesh_.notes.push_back(fmt::format("kept for glTF: {} materials with {} images",
                                        mesh_.gltf_materials->names.size(),
                                        mesh_.gltf_materials->images.size()));
    const auto is_moved = [](const PlacedMesh& part) {
      return !part.transform.isApprox(Affine3d::Identity(), 0);
    };
    const auto moved = std::count_if(placed.begin(), placed.end(), is_moved);
    if (moved > 0 || root_.size("nodes") > 1)
      mesh_.notes.push_back(
          fmt::format("{} nodes are flattened into {} objects; the transforms of {} are applied to "
                      "the vertices",
                      root_.size("nodes"), std::max(objects_, 1), moved));
    note("skins: the vertices stand where their joints place them", root_.size("skins"));
    note("animations", root_.size("animations"));
    note("cameras", root_.size("cameras"));
    note("morph targets", morph_targets_);
    note("sets of points: only triangles are read", point_sets_);
    note("sets of lines: only triangles are read", line_sets_);
    for (const auto& [name, count] : attributes_left_out_) note("vertex attributes " + name, count);
    if (root_.size("scenes") > 1) note("scenes", root_.size("scenes") - 1);
  }

  void note(std::string_view what, std::size_t count) {
    note_left_out(mesh_, static_cast<long long>(count), what);
  }

  const FileBytes& file_;
  GltfDocument document_;
  GltfObject root_;
  Mesh mesh_;
  std::vector<double> positions_;
  Column normals_{{0, 0, 0}}, texcoords_{{0, 0}}, colors_{{1, 1, 1, 1}};
  /// What one mesh's primitives share, by their accessors.
  std::map<std::vector<std::size_t>, Block> blocks_;
  std::string material_;
  int objects_ = 0;
  std::size_t morph_targets_ = 0, point_sets_ = 0, line_sets_ = 0;
  std::map<std::string, std::size_t> attributes_left_out_;
};

}  // namespace

Mesh read_gltf(const FileBytes& file) {
  return GltfReader(file).read();
}

}  // namespace supple
