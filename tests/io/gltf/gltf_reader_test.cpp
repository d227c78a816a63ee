#include <cmath>

#include <gtest/gtest.h>

#include "io/gltf/gltf_materials.h"
#include "io/mesh/mesh_files.h"
#include "tests/support/cut_files.h"
#include "tests/support/gltf_text.h"
#include "tests/support/malformed_files.h"
#include "tests/support/mesh_comparison.h"
#include "tests/support/temporary_folder.h"

namespace supple {
namespace {

using nlohmann::json;

Mesh read(const GltfText& gltf) {
  const TemporaryFolder folder;
  return read_mesh(folder.put("a.gltf", gltf.text()));
}

TEST(GltfReader, AppliesTransformsDownTheTree) {
  GltfText gltf = one_triangle();
  gltf.json["nodes"][0]["scale"] = {2, 1, 1};
  gltf.json["nodes"].push_back(
      {{"children", {0}}, {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}});
  gltf.json["nodes"].push_back({{"children", {1}}, {"translation", {10, 0, 0}}});
  gltf.json["scenes"] = {{{"nodes", {2}}}};
  const Mesh mesh = read(gltf);
  Points expected(4, 3);
  expected << 10, 0, 0, 10, 4, 0, 7, 0, 0, 10, 0, 4;
  EXPECT_LE(relative_difference(mesh.positions, expected), 1e-15);
  EXPECT_TRUE(has_note(mesh, "3 nodes are flattened into 1 objects"));
}

TEST(GltfReader, MirroredNodesKeepTheOutsideOut) {
  GltfText gltf = one_triangle();
  gltf.json["nodes"][0]["scale"] = {-1, 1, 1};
  EXPECT_EQ(read(gltf).face_vertices, (std::vector<int>{0, 2, 1}));
}

TEST(GltfReader, StripsAndFansBecomeTriangles) {
  GltfText gltf;
  const int positions = gltf.add_vectors({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0});
  const json attributes = {{"POSITION", positions}};
  gltf.show({{"attributes", attributes}, {"mode", 5}});
  EXPECT_EQ(read(gltf).face_vertices, (std::vector<int>{0, 1, 2, 1, 3, 2, 2, 3, 4}));
  gltf.json["meshes"][0]["primitives"][0] = {{"attributes", attributes}, {"mode", 6}};
  EXPECT_EQ(read(gltf).face_vertices, (std::vector<int>{0, 1, 2, 0, 2, 3, 0, 3, 4}));
  gltf.json["meshes"][0]["primitives"][0]["mode"] = 0;
  EXPECT_EQ(read(gltf).face_count(), 0);
  EXPECT_EQ(read(gltf).positions.rows(), 5);
}

TEST(GltfReader, PrimitivesShareVertices) {
  GltfText gltf = one_triangle();
  gltf.json["meshes"][0]["primitives"].push_back(
      {{"attributes", {{"POSITION", 0}}}, {"indices", gltf.add_indices({0, 2, 3})}});
  const Mesh mesh = read(gltf);
  EXPECT_EQ(mesh.positions.rows(), 4);
  EXPECT_EQ(mesh.face_vertices, (std::vector<int>{0, 1, 2, 0, 2, 3}));
}

TEST(GltfReader, NormalisedAndStridedNumbers) {
  GltfText gltf = one_triangle();
  const int colors =
      gltf.add(std::vector<std::uint8_t>{255, 0, 0, 0, 0, 255, 0, 0, 0, 0, 255, 0, 55, 55, 55, 0},
               "VEC4", 5121);
  gltf.json["accessors"][colors]["normalized"] = true;
  gltf.json["accessors"][colors]["type"] = "VEC3";
  gltf.json["bufferViews"].back()["byteStride"] = 4;
  gltf.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = colors;
  const Mesh mesh = read(gltf);
  Eigen::Matrix<double, 3, 4> expected;
  expected << 1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1;
  EXPECT_EQ(mesh.colors.values.topRows(3), expected);
  // 55/255 of linear light, by the formula of the standard.
  EXPECT_NEAR(mesh.colors.values(3, 0), 1.055 * std::pow(55 / 255.0, 1 / 2.4) - 0.055, 1e-6);
}

TEST(GltfReader, SparseAccessorsAreApplied) {
  GltfText gltf = one_triangle();
  const int places = gltf.add_indices({1, 3}), values = gltf.add_vectors({7, 8, 9, -1, -2, -3});
  json& positions = gltf.json["accessors"][0];
  positions["sparse"] = {{"count", 2},
                         {"indices", {{"bufferView", places}, {"componentType", 5123}}},
                         {"values", {{"bufferView", values}}}};
  Points expected(4, 3);
  expected << 0, 0, 0, 7, 8, 9, 0, 3, 0, -1, -2, -3;
  EXPECT_EQ(read(gltf).positions, expected);
  positions.erase("bufferView");
  expected.row(2).setZero();
  EXPECT_EQ(read(gltf).positions, expected);
}

TEST(GltfReader, SkinsStandWhereTheirJointsPlaceThem) {
  GltfText gltf = one_triangle();
  json& attributes = gltf.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = gltf.add(
      std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}, "VEC4", 5121);
  attributes["WEIGHTS_0"] = gltf.add(
      std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 1, 0, 0, 0}, "VEC4", 5126);
  std::vector<float> bind(32, 0.f);
  for (int joint = 0; joint < 2; ++joint)
    for (int i = 0; i < 4; ++i) bind[16 * joint + 5 * i] = 1;
  bind[16 + 12] = -1;  // the second joint stood at x = 1
  const int inverse = gltf.add(bind, "MAT4", 5126);
  gltf.json["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", inverse}}};
  gltf.json["nodes"][0]["skin"] = 0;
  gltf.json["nodes"][0]["translation"] = {100, 100, 100};  // skins do not follow their node
  gltf.json["nodes"].push_back({{"children", {2}}});
  gltf.json["nodes"].push_back({{"translation", {1, 0, 5}}});
  const Mesh mesh = read(gltf);
  Points expected(4, 3);
  expected << 0, 0, 0, 2, 0, 5, 0, 3, 2.5, 0, 0, 9;
  EXPECT_LE(relative_difference(mesh.positions, expected), 1e-15);
  EXPECT_TRUE(has_note(mesh, "1 skins"));
}

TEST(GltfReader, NotesWhatIsLeftOut) {
  GltfText gltf = one_triangle();
  gltf.json["animations"] = json::array({json::object()});
  gltf.json["cameras"] = json::array({json::object(), json::object()});
  json& primitive = gltf.json["meshes"][0]["primitives"][0];
  primitive["targets"] = {{{"POSITION", 0}}};
  primitive["attributes"]["TANGENT"] = 0;
  const Mesh mesh = read(gltf);
  for (const char* words :
       {"1 animations", "2 cameras", "1 morph targets", "vertex attributes TANGENT"})
    EXPECT_TRUE(has_note(mesh, words)) << words;
}

/// Materials that refer to each other's parts, with an image beside the file and one inside it.
GltfText with_materials() {
  GltfText gltf = one_triangle();
  gltf.add(std::vector<std::uint8_t>{0x89, 'P', 'N', 'G', 1, 2, 3}, "SCALAR", 5121);
  gltf.json["images"] = {
      {{"uri", "skin%20of%20paint.png"}}, {{"bufferView", 2}}, {{"uri", "../secret.png"}}};
  gltf.json["samplers"] = {{{"wrapS", 33071}}};
  gltf.json["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 1}}, {{"source", 2}}};
  gltf.json["materials"] = {
      {{"name", "paint"},
       {"extras", {{"mine", {1, 2.5, "x"}}}},
       {"extensions", {{"KHR_materials_clearcoat", {{"clearcoatTexture", {{"index", 1}}}}}}},
       {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0.25}}}},
      {{"name", "paint"}, {"occlusionTexture", {{"index", 1}, {"texCoord", 1}}}}};
  gltf.json["meshes"][0]["primitives"][0]["material"] = 1;
  return gltf;
}

TEST(GltfReader, MaterialsAndImagesAreKeptAsTheyAre) {
  const TemporaryFolder folder;
  const std::string png = "\x89PNG of paint";
  folder.put("skin of paint.png", png);
  const GltfText gltf = with_materials();
  const Mesh mesh = read_mesh(folder.put("a.gltf", gltf.text()));
  ASSERT_EQ(mesh.tags.size(), 2u);
  EXPECT_EQ(mesh.tags[1].name, "paint (2)");
  EXPECT_TRUE(has_note(mesh, "no file in the folder of this one"));
  EXPECT_TRUE(has_note(mesh, "other texture coordinates"));
  write_mesh(mesh, folder / "b.glb");
  std::filesystem::remove(folder / "skin of paint.png");
  const Mesh again = read_mesh(folder / "b.glb");
  const GltfMaterials &a = *mesh.gltf_materials, &b = *again.gltf_materials;
  EXPECT_EQ(b.materials[0], gltf.json["materials"][0]);
  EXPECT_EQ(b.materials, a.materials);
  EXPECT_EQ(b.textures, gltf.json["textures"]);
  EXPECT_EQ(b.samplers, gltf.json["samplers"]);
  EXPECT_EQ(b.image_bytes, (std::vector<std::string>{png, "\x89PNG\1\2\3", ""}));
  EXPECT_EQ(b.images[1]["mimeType"], "image/png");
  EXPECT_EQ(b.extensions, std::vector<std::string>{"KHR_materials_clearcoat"});
  expect_same_mesh(mesh, again, 1e-7);
}

/// Links and files that are no images are not given away.
TEST(GltfReader, EmbedsOnlyImagesOfItsFolder) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "in");
  folder.put("secret.png", "\x89PNG secret");
  std::filesystem::create_symlink(folder / "secret.png", folder / "in/linked.png");
  folder.put("in/id_rsa", "secret key");
  folder.put("in/paint.png", "\x89PNG");
  GltfText gltf = one_triangle();
  gltf.json["materials"] = json::array({json::object()});
  for (const char* uri : {"linked.png", "id_rsa", "%2e%2e/secret.png", "paint.png"})
    gltf.json["images"].push_back({{"uri", uri}});
  const Mesh mesh = read_mesh(folder.put("in/a.gltf", gltf.text()));
  EXPECT_EQ(mesh.gltf_materials->image_bytes, (std::vector<std::string>{"", "", "", "\x89PNG"}));
  EXPECT_TRUE(has_note(mesh, "3 images are only named"));
}

TEST(GltfReader, TextureCoordinatesCountFromBelow) {
  GltfText gltf = one_triangle();
  gltf.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
      gltf.add(std::vector<float>{0, 0, 1, 0.25f, 0.5f, 1, 0, 2}, "VEC2", 5126);
  Eigen::Matrix<double, 4, 2> expected;
  expected << 0, 1, 1, 0.75, 0.5, 0, 0, -1;
  EXPECT_EQ(read(gltf).texcoords.values, expected);
}

TEST(GltfReader, NormalsFollowStretchedAndMirroredNodes) {
  GltfText gltf = one_triangle();
  const float s = std::sqrt(0.5f);
  gltf.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
      gltf.add_vectors({s, s, 0, 0, 0, 1, 0, 1, 0, s, 0, s});
  gltf.json["nodes"][0]["matrix"] = {-2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1};
  const Mesh mesh = read(gltf);
  Points expected(4, 3);
  expected << -1, 2, 0, 0, 0, 1, 0, 1, 0, -1, 0, 2;
  expected.rowwise().normalize();
  EXPECT_LE(relative_difference(mesh.normals.values, expected), 1e-7);
  EXPECT_EQ(mesh.positions.row(1), Eigen::RowVector3d(1, 6, 7));
}

TEST(GltfReader, JointsMayStandOutsideTheScene) {
  GltfText gltf = one_triangle();
  json& attributes = gltf.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = gltf.add(std::vector<std::uint8_t>(16, 0), "VEC4", 5121);
  attributes["WEIGHTS_0"] =
      gltf.add(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 5126);
  gltf.json["skins"] = {{{"joints", {1}}}};
  gltf.json["nodes"][0]["skin"] = 0;
  gltf.json["nodes"].push_back({{"translation", {0, 100, 0}}});
  gltf.json["scenes"] = {{{"nodes", {0}}}};
  EXPECT_EQ(read(gltf).positions.row(0), Eigen::RowVector3d(0, 100, 0));
}

/// `change` makes the file wrong; the message holds `words`.
template <class Change>
void expect_refused_after(const Change& change, const std::string& words) {
  GltfText gltf = with_materials();
  change(gltf.json);
  expect_refused({{"a.gltf", gltf.text(), words}});
}

TEST(GltfReader, RefusesWhatIsNotThere) {
  expect_refused_after([](json& j) { j["accessors"][0]["count"] = 5; }, "accessors[0]: 5 elements");
  expect_refused_after([](json& j) { j["accessors"][0]["count"] = 4000000000u; }, "accessors[0]");
  expect_refused_after(
      [](json& j) {
        j["accessors"][0].erase("bufferView");
        j["accessors"][0]["count"] = 4000000000u;
      },
      "more than the buffers'");
  expect_refused_after([](json& j) { j["accessors"][0]["byteOffset"] = -4; },
                       "byteOffset: a whole number");
  expect_refused_after([](json& j) { j["accessors"][0]["bufferView"] = 9; },
                       "bufferView 9 does not exist");
  expect_refused_after([](json& j) { j["accessors"][1]["componentType"] = 5126; }, "accessors[1]");
  expect_refused_after([](json& j) { j["accessors"][0]["componentType"] = 5130; },
                       "componentType 5130");
  expect_refused_after([](json& j) { j["bufferViews"][0]["byteLength"] = 1u << 30; },
                       "bufferViews[0]: 1073741824 bytes");
  expect_refused_after([](json& j) { j["bufferViews"][0]["byteStride"] = 4; }, "byteStride 4");
  expect_refused_after([](json& j) { j["meshes"][0]["primitives"][0]["material"] = 2; },
                       "material 2 does not exist");
  expect_refused_after([](json& j) { j.erase("materials"); }, "material 1 does not exist");
  expect_refused_after([](json& j) { j["meshes"][0]["primitives"][0]["mode"] = 7; }, "mode 7");
  expect_refused_after([](json& j) { j["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 1; },
                       "NORMAL");
  expect_refused_after([](json& j) { j["nodes"][0]["mesh"] = 1; }, "mesh 1 does not exist");
  expect_refused_after([](json& j) { j["nodes"][0]["children"] = {0}; },
                       "the file has no vertices");
  expect_refused_after(
      [](json& j) {
        j["nodes"][0]["children"] = {0};
        j["scenes"] = {{{"nodes", {0}}}};
      },
      "twice");
  expect_refused_after(
      [](json& j) {
        j["nodes"][0]["scale"] = {1e200, 1e200};
      },
      "scale: an array of 3");
  expect_refused_after([](json& j) { j["nodes"][0]["rotation"] = {0, 0, 0, 0}; }, "quaternion");
  expect_refused_after([](json& j) { j["textures"][0]["source"] = 3; }, "source 3 does not exist");
  expect_refused_after([](json& j) { j["materials"][0]["normalTexture"]["index"] = 3; },
                       "index 3 does not exist");
  expect_refused_after([](json& j) { j["extensionsRequired"] = {"KHR_draco_mesh_compression"}; },
                       "KHR_draco");
  expect_refused_after([](json& j) { j["asset"]["version"] = "1.0"; }, "only glTF 2");
  expect_refused_after(
      [](json& j) {
        j["accessors"][0]["sparse"] = {{"count", 300000}};
      },
      "sparse: count 300000 of 4");
  expect_refused_after(
      [](json& j) {
        j["skins"] = {{{"joints", {1}}}};
        j["nodes"][0]["skin"] = 0;
        j["nodes"].push_back({{"children", {1}}});
      },
      "stands in no tree");
  expect_refused_after(
      [](json& j) {
        j["buffers"] = 3;
        j.erase("asset");
      },
      "asset: an object");
}

TEST(GltfReader, RefusesNumbersThatAreNotFinite) {
  GltfText gltf;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const int positions = gltf.add_vectors({0, 0, 0, 1, nan, 0, 0, 1, 0});
  gltf.show({{"attributes", {{"POSITION", positions}}}});
  expect_refused({{"a.gltf", gltf.text(), "position 1 (counted from 0) is not finite"}});
}

TEST(GltfReader, RefusesBrokenContainers) {
  const auto container = [](const std::string& words, std::uint32_t chunk,
                            const std::string& body) {
    std::string bytes = "glTF";
    const auto append = [&](std::uint32_t word) {
      bytes.append(reinterpret_cast<const char*>(&word), 4);
    };
    append(2);
    append(static_cast<std::uint32_t>(20 + body.size()));
    append(chunk);
    bytes += words + body;
    return bytes;
  };
  std::string deep = R"({"asset":{"version":"2.0"},"extras":)" + std::string(1000000, '[');
  expect_refused({{"a.glb", "glTF\2", "cut short"},
                  {"a.glb", container("JSON", 100, "{}"), "a chunk of 100 bytes, 2 are left"},
                  {"a.glb", container("BIN ", 2, "{}"), "its first chunk is not JSON"},
                  {"a.glb", container("JSON", 2, "{}"), "asset"},
                  {"a.glb", container("JSON", 2, "{]"), "it is not JSON"},
                  {"a.gltf", deep, "nests deeper than 200"}});
}

/// Small files that repeat what is large: in quadratic time each would outlast the test's time.
TEST(GltfReader, SmallFilesStaySmall) {
  GltfText names = one_triangle();
  for (int i = 0; i < 60000; ++i) names.json["materials"].push_back({{"name", "m"}});
  EXPECT_EQ(read(names).gltf_materials->names.back(), "m (60000)");
  GltfText skins = one_triangle();
  for (int i = 0; i < 20000; ++i) skins.json["skins"][0]["joints"].push_back(0);
  for (int i = 0; i < 3000; ++i) skins.json["nodes"].push_back({{"mesh", 0}, {"skin", 0}});
  EXPECT_EQ(read(skins).positions.rows(), 4 * 3001);
  GltfText extensions = one_triangle();
  extensions.json["materials"] = json::array({json::object()});
  for (int i = 0; i < 60000; ++i) {
    const std::string name = "KHR_materials_" + std::to_string(i);
    extensions.json["materials"][0]["extensions"][name] = json::object();
    extensions.json["extensionsRequired"].push_back(name);
  }
  EXPECT_EQ(read(extensions).gltf_materials->required_extensions.size(), 60000u);
}

TEST(GltfReader, RefusesMeshesRepeatedWithoutEnd) {
  GltfText gltf;
  const int positions = gltf.add_vectors(std::vector<float>(3 * 300, 1.f));
  gltf.show({{"attributes", {{"POSITION", positions}}}});
  for (int i = 1; i < 110000; ++i) gltf.json["nodes"].push_back({{"mesh", 0}});
  expect_refused({{"a.gltf", gltf.text(), "repeat meshes"}});
}

}  // namespace
}  // namespace supple
