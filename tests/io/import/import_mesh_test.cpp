#include "io/import/import_mesh.h"

#include <chrono>
#include <cstdint>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "io/errors.h"
#include "tests/support/fake_importer.h"
#include "tests/support/mesh_comparison.h"

namespace supple {
namespace {

/// A quad and a triangle with their own colors, under a node that moves and mirrors them.
constexpr const char* collada = R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g" name="kite"><mesh>
<source id="p"><float_array id="pa" count="15">0 0 0 2 0 0 2 3 0 0 3 0 1 1 4</float_array>
<technique_common><accessor source="#pa" count="5" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist count="2"><input semantic="VERTEX" source="#v" offset="0"/>
<vcount>4 3</vcount><p>0 1 2 3 0 1 4</p></polylist>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n">
<matrix>-1 0 0 10 0 1 0 0 0 0 1 0 0 0 0 1</matrix><instance_geometry url="#g"/>
</node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
)";

FileBytes put(const TemporaryFolder& folder, const std::string& name, const std::string& bytes) {
  return {.name = folder.put(name, bytes).string(), .bytes = bytes};
}

const ImporterOptions with_assimp{
    .program = SUPPLE_IMPORT_PROGRAM, .most_seconds = {}, .most_bytes = {}};

TEST(ImportMesh, ReadsForeignFormats) {
  const TemporaryFolder folder;
  const Mesh mesh = import_mesh(put(folder, "a b\n.dae", collada), with_assimp);
  Points expected(5, 3);
  expected << 10, 0, 0, 8, 0, 0, 8, 3, 0, 10, 3, 0, 9, 1, 4;
  ASSERT_EQ(mesh.positions.rows(), 5);
  EXPECT_EQ(mesh.face_starts, (std::vector<int>{0, 4, 7}));
  // The mirror turns the corners around, so that the outside stays out.
  Mesh by_order;
  for (const int vertex : {3, 2, 1, 0, 4, 1, 0}) {
    const int corner = static_cast<int>(by_order.face_vertices.size());
    EXPECT_LE((mesh.positions.row(mesh.face_vertices[corner]) - expected.row(vertex)).norm(), 1e-6)
        << corner;
    by_order.face_vertices.push_back(vertex);
  }
  ASSERT_FALSE(mesh.notes.empty());
  EXPECT_NE(mesh.notes.front().find("the order of the vertices is the importer's"),
            std::string::npos);
}

TEST(ImportMesh, RefusesWhatIsNoMesh) {
  const TemporaryFolder folder;
  const std::pair<const char*, const char*> files[] = {
      {"a.txt", "hello\n"}, {"a.dae", "<COLLADA>"}, {"a.3ds", "MM\xff\xff\xff\xff"}};
  for (const auto& file : files)
    EXPECT_NE(message_of<InputError>([&] {
                import_mesh(put(folder, file.first, file.second), with_assimp);
              }).find("none of our formats"),
              std::string::npos);
}

/// What `lines` do instead of importing.
template <class Error>
std::string message_after(const std::string& lines) {
  const TemporaryFolder folder;
  const ImporterOptions options{
      .program = fake_importer(folder, lines), .most_seconds = 1, .most_bytes = 1 << 20};
  return message_of<Error>([&] { import_mesh(put(folder, "a.fbx", "x"), options); });
}

TEST(ImportMesh, OutlivesTheImporter) {
  const auto says = [](const std::string& message, std::string_view words) {
    EXPECT_NE(message.find(words), std::string::npos) << message;
  };
  const auto start = std::chrono::steady_clock::now();
  says(message_after<ImporterError>("kill -SEGV $$"), "crashed: Segmentation fault");
  says(message_after<ImporterError>("exit 1"), "crashed: it ended with code 1");
  says(message_after<ImporterError>("exec sleep 100"), "did not end within 1 s");
  says(message_after<ImporterError>("exec >&- 2>&-; exec sleep 100"), "did not end within 1 s");
  says(message_after<ImporterError>("exec yes v 0 0 0"), "more than its memory could hold");
  says(message_after<ImporterError>("yes error >&2 & exec sleep 100"), "did not end within 1 s");
  says(message_after<InputError>("echo why >&2; exit 3"), "says: why");
  says(message_after<InputError>("echo 'v 0 0 nan'"), "(as imported):1: vertex 1");
  says(message_after<InputError>("printf 'v 0 0 0\\nf 1 2 3\\n'"), "vertex 3 does not exist");
  says(message_after<InputError>("exit 0"), "no vertices");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(8));
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "a child is left behind";
}

TEST(ImportMesh, SaysWhereItIsMissing) {
  const TemporaryFolder folder;
  const FileBytes file = put(folder, "a.fbx", "x");
  EXPECT_NE(message_of<ImporterError>([&] {
              import_mesh(file, {.program = folder / "none", .most_seconds = {}, .most_bytes = {}});
            }).find("cannot be started: No such file"),
            std::string::npos);
}

std::string big_endian(std::uint32_t number, int bytes) {
  std::string text;
  for (int i = bytes - 1; i >= 0; --i) text += static_cast<char>(number >> 8 * i & 255);
  return text;
}

std::string chunk(const std::string& name, const std::string& bytes) {
  return name + big_endian(static_cast<std::uint32_t>(bytes.size()), 4) + bytes;
}

/// A triangle as a LightWave object, which scenes name by its path.
std::string lightwave_triangle() {
  std::string points(36, '\0');
  points.replace(12, 2, "\x3f\x80").replace(28, 2, "\x3f\x80");  // two ones
  const std::string face =
      "FACE" + big_endian(3, 2) + big_endian(0, 2) + big_endian(1, 2) + big_endian(2, 2);
  const std::string name("a\0", 2);
  return chunk("FORM", "LWO2" + chunk("TAGS", name) + chunk("LAYR", std::string(18, '\0')) +
                           chunk("PNTS", points) + chunk("POLS", face) +
                           chunk("PTAG", "SURF" + std::string(4, '\0')) +
                           chunk("SURF", name + std::string(2, '\0')));
}

/// A file may not name others that are not beside it.
TEST(ImportMesh, SeesOnlyTheFilesFolder) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "in");
  folder.put("secret.lwo", lightwave_triangle());
  folder.put("in/object.lwo", lightwave_triangle());
  std::filesystem::create_symlink(folder / "secret.lwo", folder / "in/link.lwo");
  const auto scene_of = [&](const std::string& object) {
    const std::string text = "LWSC\n3\n\nLoadObjectLayer 1 " + object + "\nShowObject 7 3\n";
    return import_mesh(put(folder, "in/a.lws", text), with_assimp);
  };
  EXPECT_EQ(scene_of("object.lwo").positions.rows(), 3);
  for (const std::string& object :
       {std::string("../secret.lwo"), (folder / "secret.lwo").string(), std::string("link.lwo")})
    EXPECT_NE(message_of<InputError>([&] { scene_of(object); }).find("no vertices"),
              std::string::npos)
        << object;
}

}  // namespace
}  // namespace supple
