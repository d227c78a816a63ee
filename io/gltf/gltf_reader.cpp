#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>

#include "io/gltf/gltf_accessor.h"
#include "io/gltf/gltf_document.h"
#include "io/gltf/gltf_formats.h"
#include "io/gltf/gltf_materials.h"
#include "io/gltf/gltf_nodes.h"
#include "io/gltf/gltf_vertices.h"
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

class GltfReader {
 public:
  explicit GltfReader(const FileBytes& file)
      : file_(file), document_(open_gltf(file)), root_(document_.root()), vertices_(document_) {}

  Mesh read() {
    mesh_.notes = document_.notes;
    mesh_.gltf_materials = take_materials(document_, mesh_.notes);
    const std::vector<PlacedMesh> placed = placed_meshes(document_);
    check_size(placed);
    for (const PlacedMesh& part : placed) read_faces(part);
    if (mesh_.face_count() == 0)
      for (const PlacedMesh& part : placed) read_points(part);
    if (vertices_.count() == 0 && line_sets_ > 0) root_.fail("it has lines alone");
    vertices_.take(mesh_);
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
    if (primitive.has("material")) {
      const std::size_t index = primitive.index("material", root_.size("materials"), "materials");
      name = mesh_.gltf_materials->names[index];
    }
    if (name == material_) return;
    mesh_.tags.push_back({FaceTag::Kind::material, name, mesh_.face_count()});
    material_ = name;
  }

  void add_triangles(const PlacedMesh& placed, const GltfObject& primitive, std::size_t mode) {
    const auto [first, count] = add_vertices(placed, primitive);
    std::vector<int> corners;
    if (primitive.has("indices")) {
      corners = read_indices(document_, accessor_of(document_, primitive, "indices"),
                             static_cast<std::size_t>(count));
    } else {
      for (int i = 0; i < count; ++i) corners.push_back(i);
    }
    const bool is_skinned = placed.joints && primitive.object("attributes").has("JOINTS_0");
    const bool mirrored = !is_skinned && placed.transform.linear().determinant() < 0;
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
    const auto [block, is_new] =
        blocks_.try_emplace(accessors_of(attributes), Block{vertices_.count(), 0});
    if (is_new) {
      block->second.count = vertices_.append(placed, attributes);
      morph_targets_ += primitive.size("targets");
      for (const auto& attribute : attributes.value().items()) note_attribute(attribute.key());
    }
    return block->second;
  }

  /// By which primitives know that they share vertices.
  std::vector<std::size_t> accessors_of(const GltfObject& attributes) const {
    std::vector<std::size_t> accessors;
    for (const char* name :
         {"POSITION", "NORMAL", "TEXCOORD_0", "COLOR_0", "JOINTS_0", "WEIGHTS_0"})
      accessors.push_back(attributes.has(name) ? accessor_of(document_, attributes, name) : -1);
    return accessors;
  }

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
        size += std::min(root_.item("accessors", accessor_of(document_, owner, key)).whole("count"),
                         document_.size());
    };
    std::set<std::vector<std::size_t>> blocks;
    for (std::size_t i = 0; i < mesh.size("primitives"); ++i) {
      const GltfObject primitive = mesh.item("primitives", i);
      const GltfObject attributes = primitive.object("attributes");
      add(primitive, "indices");
      if (blocks.insert(accessors_of(attributes)).second) add(attributes, "POSITION");
    }
    return size;
  }

  void note_attribute(const std::string& name) {
    for (const char* known : {"POSITION", "NORMAL", "TEXCOORD_0", "COLOR_0"})
      if (name == known) return;
    if (name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_")) return;
    ++attributes_left_out_[name];
  }

  void note_what_is_kept(const std::vector<PlacedMesh>& placed) {
    if (const GltfMaterials* kept = mesh_.gltf_materials.get())
      mesh_.notes.push_back(
          fmt::format("kept for glTF: {} materials with {} images", kept->names.size(),
                      std::count_if(kept->image_bytes.begin(), kept->image_bytes.end(),
                                    [](const std::string& bytes) { return !bytes.empty(); })));
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
    note_extensions();
  }

  void note_extensions() {
    std::vector<std::string> known;
    if (mesh_.gltf_materials) known = mesh_.gltf_materials->extensions;
    for (std::size_t i = 0; i < root_.size("extensionsUsed"); ++i) {
      const nlohmann::json& name = document_.json["extensionsUsed"][i];
      if (!name.is_string() || name == "KHR_mesh_quantization") continue;
      if (!std::binary_search(known.begin(), known.end(), name.get<std::string>()))
        mesh_.notes.push_back("left out: extension " + name.get<std::string>().substr(0, 80));
    }
  }

  void note(std::string_view what, std::size_t count) {
    note_left_out(mesh_, static_cast<long long>(count), what);
  }

  const FileBytes& file_;
  GltfDocument document_;
  GltfObject root_;
  Mesh mesh_;
  GltfVertices vertices_;
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
