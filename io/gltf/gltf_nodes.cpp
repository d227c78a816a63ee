#include "io/gltf/gltf_nodes.h"

#include <map>

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
        parents_(find_parents()),
        world_(count_, Affine3d::Identity()),
        is_placed_(count_, false) {
    for (const std::size_t top : tops()) walk(top, [this](std::size_t node) { place(node); });
  }

  std::vector<PlacedMesh> meshes() {
    std::vector<PlacedMesh> placed;
    std::vector<bool> is_seen(count_, false);
    for (const std::size_t top : scene_nodes())
      walk(top, [&](std::size_t index) {
        const GltfObject node = root_.item("nodes", index);
        if (is_seen[index] || !is_placed_[index]) node.fail(in_tree_twice);
        is_seen[index] = true;
        if (node.has("mesh")) placed.push_back(placed_mesh(node, world_[index]));
      });
    return placed;
  }

 private:
  static constexpr const char* in_tree_twice = "it stands in the scene's tree twice";

  std::vector<std::size_t> children(std::size_t node) const {
    return root_.item("nodes", node).indices("children", count_);
  }

  std::vector<std::size_t> find_parents() const {
    std::vector<std::size_t> parents(count_, count_);
    for (std::size_t node = 0; node < count_; ++node)
      for (const std::size_t child : children(node)) {
        if (parents[child] < count_) root_.item("nodes", child).fail(in_tree_twice);
        parents[child] = node;
      }
    return parents;
  }

  std::vector<std::size_t> tops() const {
    std::vector<std::size_t> tops;
    for (std::size_t node = 0; node < count_; ++node)
      if (parents_[node] == count_) tops.push_back(node);
    return tops;
  }

  std::vector<std::size_t> scene_nodes() const {
    if (root_.size("scenes") == 0) return tops();
    const std::size_t scene =
        root_.has("scene") ? root_.index("scene", root_.size("scenes"), "scenes") : 0;
    return root_.item("scenes", scene).indices("nodes", count_);
  }

  /// Visits a node, and then all below it, by a stack of its own: trees may be as deep as they
  /// like. `visit` throws where it comes around to a node again.
  template <class Visit>
  void walk(std::size_t top, const Visit& visit) const {
    std::vector<std::size_t> stack{top};
    while (!stack.empty()) {
      const std::size_t node = stack.back();
      stack.pop_back();
      visit(node);
      const std::vector<std::size_t> below = children(node);
      stack.insert(stack.end(), below.rbegin(), below.rend());
    }
  }

  void place(std::size_t index) {
    const GltfObject node = root_.item("nodes", index);
    const Affine3d local = local_transform(node);
    world_[index] = parents_[index] < count_ ? world_[parents_[index]] * local : local;
    if (!world_[index].matrix().allFinite()) node.fail("its place is not finite");
    is_placed_[index] = true;
  }

  PlacedMesh placed_mesh(const GltfObject& node, const Affine3d& transform) {
    const std::size_t mesh = node.index("mesh", root_.size("meshes"), "meshes");
    const std::string own = short_name(node);
    PlacedMesh placed{mesh, own.empty() ? short_name(root_.item("meshes", mesh)) : own, transform,
                      nullptr};
    if (node.has("skin")) placed.joints = joints(node.index("skin", root_.size("skins"), "skins"));
    return placed;
  }

  /// Computed once, however many meshes share the skin.
  std::shared_ptr<const std::vector<Affine3d>> joints(std::size_t index) {
    auto& shared = skins_[index];
    if (!shared) shared = std::make_shared<const std::vector<Affine3d>>(joint_transforms(index));
    return shared;
  }

  std::vector<Affine3d> joint_transforms(std::size_t index) const {
    const GltfObject skin = root_.item("skins", index);
    std::vector<Affine3d> transforms;
    for (const std::size_t node : skin.indices("joints", count_)) {
      if (!is_placed_[node]) skin.fail(fmt::format("joint {} stands in no tree", node));
      transforms.push_back(world_[node]);
    }
    if (!skin.has("inverseBindMatrices")) return transforms;
    const AccessorValues inverse = read_accessor(
        document_, accessor_of(document_, skin, "inverseBindMatrices"), {16}, "bind matrix");
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
  std::vector<std::size_t> parents_;  ///< count_: none
  std::vector<Affine3d> world_;
  std::vector<bool> is_placed_;  ///< all but nodes that are above themselves
  std::map<std::size_t, std::shared_ptr<const std::vector<Affine3d>>> skins_;
};

}  // namespace

std::vector<PlacedMesh> placed_meshes(const GltfDocument& document) {
  return NodeTree(document).meshes();
}

}  // namespace supple
