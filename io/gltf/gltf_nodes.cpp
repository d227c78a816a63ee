#include "io/gltf/gltf_nodes.h"

#include <fmt/format.h>

#include "io/gltf/gltf_accessor.h"

namespace supple {
namespace {

using Eigen::Affine3d;

Affine3d local_transform(const GltfObject& node) {
  Affine3d transform = Affine3d::Identity();
  if (node.has("matrix")) {
    const std::vector<double> m =
        node.numbers("matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    transform.affine() = Eigen::Map<const Eigen::Matrix4d>(m.data()).topRows<3>();
    return transform;
  }
  const std::vector<double> t = node.numbers("translation", {0, 0, 0});
  const std::vector<double> r = node.numbers("rotation", {0, 0, 0, 1});
  const std::vector<double> s = node.numbers("scale", {1, 1, 1});
  Eigen::Quaterniond rotation(r[3], r[0], r[1], r[2]);
  if (rotation.norm() < 1e-3) node.fail("rotation: a unit quaternion is expected");
  rotation.normalize();
  return Eigen::Translation3d(t[0], t[1], t[2]) * rotation * Eigen::Scaling(s[0], s[1], s[2]);
}

class NodeTree {
 public:
  explicit NodeTree(const GltfDocument& document)
      : document_(document),
        root_(document.root()),
        count_(root_.size("nodes")),
        world_(count_, Affine3d::Identity()),
        in_scene_(count_, false) {
    for (const std::size_t node : top_nodes()) visit(node, Affine3d::Identity());
  }

  std::vector<PlacedMesh> meshes() const {
    std::vector<PlacedMesh> placed;
    for (const std::size_t index : order_) {
      const GltfObject node = root_.item("nodes", index);
      if (!node.has("mesh")) continue;
      const std::size_t mesh = node.index("mesh", root_.size("meshes"), "meshes");
      const std::string name = node.text("name", root_.item("meshes", mesh).text("name", ""));
      placed.push_back({mesh, name, world_[index], {}});
      if (node.has("skin"))
        placed.back().joints = joints(node.index("skin", root_.size("skins"), "skins"));
    }
    return placed;
  }

 private:
  std::vector<std::size_t> top_nodes() const {
    if (root_.size("scenes") == 0) return nodes_without_parent();
    const std::size_t scene =
        root_.has("scene") ? root_.index("scene", root_.size("scenes"), "scenes") : 0;
    return root_.item("scenes", scene).indices("nodes", count_);
  }

  std::vector<std::size_t> nodes_without_parent() const {
    std::vector<bool> is_child(count_, false);
    for (std::size_t node = 0; node < count_; ++node)
      for (const std::size_t child : children(node)) is_child[child] = true;
    std::vector<std::size_t> tops;
    for (std::size_t node = 0; node < count_; ++node)
      if (!is_child[node]) tops.push_back(node);
    return tops;
  }

  std::vector<std::size_t> children(std::size_t node) const {
    return root_.item("nodes", node).indices("children", count_);
  }

  /// Walks down from a top node; with a stack of its own, since trees may be as deep as they like.
  void visit(std::size_t top, const Affine3d& parent) {
    std::vector<std::pair<std::size_t, Affine3d>> stack{{top, parent}};
    while (!stack.empty()) {
      const auto [index, above] = stack.back();
      stack.pop_back();
      const GltfObject node = root_.item("nodes", index);
      if (in_scene_[index]) node.fail("it stands in the scene's tree twice");
      in_scene_[index] = true;
      order_.push_back(index);
      world_[index] = above * local_transform(node);
      if (!world_[index].matrix().allFinite()) node.fail("its place is not finite");
      const std::vector<std::size_t> below = children(index);
      for (auto child = below.rbegin(); child != below.rend(); ++child)
        stack.emplace_back(*child, world_[index]);
    }
  }

  std::vector<Affine3d> joints(std::size_t index) const {
    const GltfObject skin = root_.item("skins", index);
    std::vector<Affine3d> transforms;
    for (const std::size_t node : skin.indices("joints", count_))
      transforms.push_back(world_[node]);
    if (!skin.has("inverseBindMatrices")) return transforms;
    const std::size_t accessor =
        skin.index("inverseBindMatrices", root_.size("accessors"), "accessors");
    const AccessorValues inverse = read_accessor(document_, accessor, {16}, "bind matrix");
    if (inverse.rows() < static_cast<Eigen::Index>(transforms.size()))
      skin.fail("it has fewer inverseBindMatrices than joints");
    for (std::size_t joint = 0; joint < transforms.size(); ++joint) {
      Affine3d from_mesh = Affine3d::Identity();
      from_mesh.affine() =
          Eigen::Map<const Eigen::Matrix4d>(inverse.row(static_cast<Eigen::Index>(joint)).data())
              .topRows<3>();
      transforms[joint] = transforms[joint] * from_mesh;
    }
    return transforms;
  }

  const GltfDocument& document_;
  GltfObject root_;
  std::size_t count_;
  std::vector<Affine3d> world_;  ///< of a node of the scene
  std::vector<bool> in_scene_;
  std::vector<std::size_t> order_;
};

}  // namespace

std::vector<PlacedMesh> placed_meshes(const GltfDocument& document) {
  return NodeTree(document).meshes();
}

}  // namespace supple
