#include "modeler/domain/select.h"

#include <functional>

#include <gtest/gtest.h>

#include "io/errors.h"
#include "tests/support/shapes.h"
#include "tests/support/temporary_folder.h"

namespace supple {
namespace {

/// A box [0,1]×[0,2]×[0,4] with samples no wider than 0.2, and its groups.
class Select : public testing::Test {
 protected:
  Select() {
    mesh_ = make_bar({1, 2, 4}, {1, 1, 1});  // two triangles for each of x=0, x=1, y=0, ...
    mesh_.tags = {{FaceTag::Kind::object, "crate", 0},  {FaceTag::Kind::group, "left", 0},
                  {FaceTag::Kind::material, "wood", 0}, {FaceTag::Kind::group, "right outer", 2},
                  {FaceTag::Kind::material, "iron", 4}, {FaceTag::Kind::group, "rest", 4},
                  {FaceTag::Kind::smoothing, "off", 4}};
    triangulation_.triangles = triangles_of(mesh_);
    for (int face = 0; face < mesh_.face_count(); ++face) triangulation_.faces.push_back(face);
    samples_ = sample_surface(mesh_.positions, triangulation_.triangles, 0.2);
  }

  std::vector<int> chosen(const std::string& text) {
    const SelectionContext context{mesh_, triangulation_, bounding_box(mesh_.positions),
                                   folder_.path()};
    return select(parse_selection(text, {"scene.yaml", 3, 7}), context, samples_);
  }

  /// The chosen samples are those for which `test` holds, and neither all nor none.
  void expect(const std::string& text, const std::function<bool(const Vec3&)>& test) {
    std::vector<int> expected;
    for (Index i = 0; i < samples_.size(); ++i)
      if (test(samples_.positions.row(i))) expected.push_back(static_cast<int>(i));
    EXPECT_FALSE(expected.empty()) << text;
    EXPECT_LT(static_cast<Index>(expected.size()), samples_.size()) << text;
    EXPECT_EQ(chosen(text), expected) << text;
  }

  std::string refusal(const std::string& text) {
    return message_of<UsageError>([&] { chosen(text); });
  }

  TemporaryFolder folder_;
  Mesh mesh_;
  Triangulation triangulation_;
  SurfaceSamples samples_;
};

TEST_F(Select, ComparisonsInUnitsAndPercentOfTheAxis) {
  expect("x<0.25", [](const Vec3& x) { return x.x() < 0.25; });
  expect("y<=10%", [](const Vec3& x) { return x.y() <= 0.2; });
  expect("z>75%", [](const Vec3& x) { return x.z() > 3; });
  expect("x>=1", [](const Vec3& x) { return x.x() >= 1; });
  expect("y:85%..", [](const Vec3& x) { return x.y() > 1.7; });
}

TEST_F(Select, BoxAndSphereInUnits) {
  expect("box(0,0,0,0.5,1,2)",
         [](const Vec3& x) { return x.x() <= 0.5 && x.y() <= 1 && x.z() <= 2; });
  expect("sphere(1,2,4,0.8)", [](const Vec3& x) { return (x - Vec3(1, 2, 4)).norm() <= 0.8; });
}

TEST_F(Select, PercentsOfBoxAndSphereAreDiagonalsFromTheCentre) {
  const double d = std::sqrt(21.0);
  const Vec3 c(0.5, 1, 2);
  expect("sphere(0,20%,0,15%)",
         [&](const Vec3& x) { return (x - c - Vec3(0, 0.2 * d, 0)).norm() <= 0.15 * d; });
  expect("box(-50%,-50%,-50%,50%,50%,0)", [&](const Vec3& x) { return x.z() <= 2; });
  expect("box(0,-50%,-50%,50%,50%,50%)", [&](const Vec3& x) { return x.x() >= 0.5; });
}

TEST_F(Select, NearestIsOneSample) {
  const std::vector<int> one = chosen("nearest(5,1,2)");
  ASSERT_EQ(one.size(), 1u);
  const Vec3 x = samples_.positions.row(one[0]);
  EXPECT_LT((x - Vec3(1, 1, 2)).norm(), 0.2);
}

TEST_F(Select, AndOrNot) {
  expect("x<50% and not y>50%", [](const Vec3& x) { return x.x() < 0.5 && x.y() <= 1; });
  expect("x<10% or y<10% or z<10%",
         [](const Vec3& x) { return x.x() < 0.1 || x.y() < 0.2 || x.z() < 0.4; });
  expect("not (x<50% and y<50%)", [](const Vec3& x) { return x.x() >= 0.5 || x.y() >= 1; });
  EXPECT_EQ(static_cast<Index>(chosen("not x>200%").size()), samples_.size());
}

TEST_F(Select, GroupsObjectsAndMaterials) {
  expect("group(left)", [](const Vec3& x) { return x.x() == 0; });
  expect("group(right)", [](const Vec3& x) { return x.x() == 1; });
  expect("group(outer)", [](const Vec3& x) { return x.x() == 1; });
  expect("group(wood)", [](const Vec3& x) { return x.x() == 0 || x.x() == 1; });
  expect("group(rest)", [](const Vec3& x) { return x.x() != 0 && x.x() != 1; });
  EXPECT_EQ(static_cast<Index>(chosen("group(crate)").size()), samples_.size());
}

TEST_F(Select, UnknownGroupNamesTheNearest) {
  const std::string words = refusal("group(lefft)");
  EXPECT_EQ(words.rfind("scene.yaml:3:7", 0), 0u) << words;
  EXPECT_NE(words.find("'left'"), std::string::npos) << words;
  EXPECT_NE(words.find("crate"), std::string::npos) << words;
  EXPECT_EQ(words.find("off"), std::string::npos) << words;
  mesh_.tags.clear();
  EXPECT_NE(refusal("group(left)").find("no groups"), std::string::npos);
}

TEST_F(Select, VerticesOfAFile) {
  folder_.put("list.txt", "# the first corner\n0 \t 3\r\n");
  int listed = 0;
  for (int i : chosen("vertices(list.txt)")) {
    EXPECT_TRUE(samples_.vertices[i] == 0 || samples_.vertices[i] == 3);
    ++listed;
  }
  int expected = 0;
  for (int vertex : samples_.vertices) expected += vertex == 0 || vertex == 3 ? 1 : 0;
  EXPECT_EQ(listed, expected);
  EXPECT_GT(listed, 0);
}

TEST_F(Select, WrongVertexFilesAreRefusedWithTheirLine) {
  folder_.put("far.txt", "0\n1 2\n 8\n");
  EXPECT_NE(refusal("vertices(far.txt)").find("far.txt:3:2: there is no vertex 8"),
            std::string::npos);
  folder_.put("word.txt", "0\n1 two\n");
  EXPECT_NE(refusal("vertices(word.txt)").find("word.txt:2:3: 'two' is not a vertex number"),
            std::string::npos);
  folder_.put("minus.txt", "-1");
  EXPECT_NE(refusal("vertices(minus.txt)").find("minus.txt:1:1: there is no vertex -1"),
            std::string::npos);
  folder_.put("huge.txt", "99999999999999999999999");
  EXPECT_NE(refusal("vertices(huge.txt)").find("huge.txt:1:1: there is no vertex 9999"),
            std::string::npos);
  const std::string missing = message_of<InputError>([&] { chosen("vertices(none.txt)"); });
  EXPECT_EQ(missing.rfind("scene.yaml:3:7", 0), 0u) << missing;
  EXPECT_NE(missing.find("none.txt"), std::string::npos);
}

TEST_F(Select, NothingSelectedNamesTheBoxAndTheText) {
  const std::string words = refusal("y>200%");
  EXPECT_EQ(words.rfind("scene.yaml:3:7", 0), 0u) << words;
  EXPECT_NE(words.find("'y>200%' selects nothing"), std::string::npos) << words;
  EXPECT_NE(words.find("(0, 0, 0) to (1, 2, 4)"), std::string::npos) << words;
}

}  // namespace
}  // namespace supple
