#include "importer/import_scene.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include "io/mesh/mesh_checks.h"
#include "io/mesh/plain_name.h"

namespace supple {
namespace {

/// Lets assimp see the file's folder and what is below it, nothing else of the user's.
class FolderOnly : public Assimp::DefaultIOSystem {
 public:
  explicit FolderOnly(const std::filesystem::path& file)
      : folder_(std::filesystem::canonical(file).parent_path()) {}

  bool Exists(const char* path) const override {
    return is_below(path) && DefaultIOSystem::Exists(path);
  }
  Assimp::IOStream* Open(const char* path, const char* mode) override {
    return *mode == 'r' && is_below(path) ? DefaultIOSystem::Open(path, mode) : nullptr;
  }

 private:
  bool is_below(const char* path) const {
    std::error_code error;
    const std::filesystem::path place = std::filesystem::weakly_canonical(path, error);
    if (error || std::filesystem::is_directory(place, error)) return false;
    const auto [end, unused] =
        std::mismatch(folder_.begin(), folder_.end(), place.begin(), place.end());
    return end == folder_.end();
  }

  std::filesystem::path folder_;
};

std::string name_of(const aiString& name) {
  const std::string plain = plain_name({name.data, std::min<std::size_t>(name.length, MAXLEN - 1)});
  return plain.empty() ? "unnamed" : plain;
}

class SceneReader {
 public:
  explicit SceneReader(const aiScene& scene) : scene_(scene) {}

  Mesh read() {
    read_node(*scene_.mRootNode, aiMatrix4x4(), 0);
    take_values();
    note_left_out(mesh_, animations(), "animations");
    note_left_out(mesh_, bones_, "bones: the vertices stand where the file has them");
    note_left_out(mesh_, textures(), "textures");
    note_left_out(mesh_, scene_.mNumCameras, "cameras");
    note_left_out(mesh_, scene_.mNumLights, "lights");
    note_left_out(mesh_, morph_targets_, "morph targets");
    note_left_out(mesh_, further_sets_, "further sets of texture coordinates and colors");
    if ((scene_.mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0)
      mesh_.notes.push_back("assimp says that the scene is not complete");
    note_left_out(mesh_, thin_, "points and lines");
    return std::move(mesh_);
  }

 private:
  static constexpr int deepest = 2'000;

  void read_node(const aiNode& node, const aiMatrix4x4& above, int depth) {
    if (depth > deepest) throw std::runtime_error("its nodes nest too deep");
    const aiMatrix4x4 transform = above * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      if (node.mMeshes[i] >= scene_.mNumMeshes)
        throw std::runtime_error("a node shows a mesh that does not exist");
      read_mesh(*scene_.mMeshes[node.mMeshes[i]], node, transform);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i)
      if (node.mChildren[i])  // some readers leave gaps
        read_node(*node.mChildren[i], transform, depth + 1);
  }

  void read_mesh(const aiMesh& from, const aiNode& node, const aiMatrix4x4& transform) {
    const auto first = static_cast<int>(positions_.size());
    mesh_.tags.push_back({FaceTag::Kind::object,
                          name_of(from.mName.length > 0 ? from.mName : node.mName),
                          mesh_.face_count()});
    if (from.mMaterialIndex < scene_.mNumMaterials)
      mesh_.tags.push_back({FaceTag::Kind::material,
                            name_of(scene_.mMaterials[from.mMaterialIndex]->GetName()),
                            mesh_.face_count()});
    const aiMatrix3x3 turn = aiMatrix3x3(transform).Inverse().Transpose();
    for (unsigned i = 0; i < from.mNumVertices; ++i) add_vertex(from, i, transform, turn);
    const bool mirrored = aiMatrix3x3(transform).Determinant() < 0;
    for (unsigned i = 0; i < from.mNumFaces; ++i) add_face(from, from.mFaces[i], first, mirrored);
    bones_ += from.mNumBones;
    morph_targets_ += from.mNumAnimMeshes;
    further_sets_ += std::max(from.GetNumUVChannels(), 1u) - 1;
    further_sets_ += std::max(from.GetNumColorChannels(), 1u) - 1;
  }

  void add_vertex(const aiMesh& from, unsigned i, const aiMatrix4x4& transform,
                  const aiMatrix3x3& turn) {
    const aiVector3D x = transform * from.mVertices[i];
    if (!std::isfinite(x.x) || !std::isfinite(x.y) || !std::isfinite(x.z))
      throw std::runtime_error(
          fmt::format("vertex {} of \"{}\" is not finite", i, name_of(from.mName)));
    positions_.emplace_back(x.x, x.y, x.z);
    aiVector3D n = from.HasNormals() ? (turn * from.mNormals[i]).NormalizeSafe() : aiVector3D();
    if (!std::isfinite(n.x + n.y + n.z)) n = {};
    normals_.emplace_back(n.x, n.y, n.z);
    has_normals_ = has_normals_ || from.HasNormals();
    const aiVector3D uv = from.HasTextureCoords(0) ? from.mTextureCoords[0][i] : aiVector3D();
    const bool finite = std::isfinite(uv.x + uv.y);
    texcoords_.emplace_back(finite ? uv.x : 0, finite ? uv.y : 0);
    has_texcoords_ = has_texcoords_ || from.HasTextureCoords(0);
    const aiColor4D color = from.HasVertexColors(0) ? from.mColors[0][i] : aiColor4D(1, 1, 1, 1);
    colors_.push_back({channel(color.r), channel(color.g), channel(color.b), channel(color.a)});
    has_colors_ = has_colors_ || from.HasVertexColors(0);
  }

  static double channel(float value) {
    return std::isfinite(value) ? std::clamp(value, 0.f, 1.f) : 0.;
  }

  void add_face(const aiMesh& from, const aiFace& face, int first, bool mirrored) {
    for (unsigned i = 0; i < face.mNumIndices; ++i)
      if (face.mIndices[i] >= from.mNumVertices)
        throw std::runtime_error(fmt::format("a face of \"{}\" uses vertex {} of {}",
                                             name_of(from.mName), face.mIndices[i],
                                             from.mNumVertices));
    if (face.mNumIndices < 3) {
      ++thin_;
      return;
    }
    for (unsigned i = 0; i < face.mNumIndices; ++i)
      mesh_.face_vertices.push_back(
          first + static_cast<int>(face.mIndices[mirrored ? face.mNumIndices - 1 - i : i]));
    mesh_.face_starts.push_back(static_cast<int>(mesh_.face_vertices.size()));
  }

  void take_values() {
    const auto rows = static_cast<Index>(positions_.size());
    if (rows == 0) throw std::runtime_error("the file has no vertices");
    mesh_.positions.resize(rows, 3);
    for (Index i = 0; i < rows; ++i) mesh_.positions.row(i) = positions_[i];
    const auto take = [&](bool present, const auto& values, auto& attribute) {
      if (!present) return;
      attribute.values.resize(rows, attribute.values.cols());
      for (Index i = 0; i < rows; ++i) attribute.values.row(i) = values[i];
    };
    take(has_normals_, normals_, mesh_.normals);
    take(has_texcoords_, texcoords_, mesh_.texcoords);
    take(has_colors_, colors_, mesh_.colors);
  }

  long long animations() const { return scene_.mNumAnimations; }

  long long textures() const {
    long long count = 0;
    for (unsigned i = 0; i < scene_.mNumMaterials; ++i)
      for (int type = aiTextureType_DIFFUSE; type <= AI_TEXTURE_TYPE_MAX; ++type)
        count += scene_.mMaterials[i]->GetTextureCount(static_cast<aiTextureType>(type));
    return count;
  }

  const aiScene& scene_;
  Mesh mesh_;
  std::vector<Eigen::RowVector3d> positions_, normals_;
  std::vector<Eigen::RowVector2d> texcoords_;
  std::vector<Eigen::RowVector4d> colors_;
  bool has_normals_ = false, has_texcoords_ = false, has_colors_ = false;
  long long bones_ = 0, thin_ = 0, morph_targets_ = 0, further_sets_ = 0;
};

}  // namespace

Mesh import_scene(const std::filesystem::path& path) {
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, 1);  // which no file has
  importer.SetIOHandler(new FolderOnly(path));  // which the importer deletes
  // Their counts are checked against the file's size by our own readers alone.
  for (const char* ours : {"obj", "off", "ply", "stl", "gltf", "glb"})
    while (Assimp::BaseImporter* reader = importer.GetImporter(ours))
      if (importer.UnregisterLoader(reader) != aiReturn_SUCCESS) break;
  const aiScene* scene = importer.ReadFile(path.string(), aiProcess_JoinIdenticalVertices);
  if (!scene || !scene->mRootNode) throw std::runtime_error(importer.GetErrorString());
  return SceneReader(*scene).read();
}

}  // namespace supple
