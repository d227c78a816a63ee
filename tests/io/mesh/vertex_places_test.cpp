#include "io/mesh/vertex_places.h"

#include <gtest/gtest.h>

#include "io/errors.h"
#include "tests/support/temporary_folder.h"

namespace supple {
namespace {

std::string complaint_about(const std::string& text) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.put("targets.txt", text);
  const std::string message = message_of<InputError>([&] { read_vertex_places(path, 10); });
  return message.substr(message.rfind('/') + 1);
}

TEST(VertexPlaces, AreReadInAnyOrder) {
  const TemporaryFolder folder;
  const VertexPlaces places = read_vertex_places(
      folder.put("targets.txt", "# number x y z\n7 1 2 3\n\n0 -1e-3 .5 4 # nose\n"), 10);
  EXPECT_EQ(places.vertices, (std::vector<int>{0, 7}));
  EXPECT_EQ(places.places.row(0), Eigen::RowVector3d(-1e-3, 0.5, 4));
  EXPECT_EQ(places.places.row(1), Eigen::RowVector3d(1, 2, 3));
}

TEST(VertexPlaces, TellTheLineOfAMistake) {
  EXPECT_EQ(complaint_about("1 0 0 0\n10 1 2 3\n"),
            "targets.txt:2: there is no vertex 10; the shape has vertices 0 to 9");
  EXPECT_EQ(complaint_about("-1 1 2 3\n"),
            "targets.txt:1: there is no vertex -1; the shape has vertices 0 to 9");
  EXPECT_EQ(complaint_about("1 0 0 0\n2 0 0 0\n1 1 1 1\n"),
            "targets.txt:3: vertex 1: is listed twice; line 1 has it already");
  EXPECT_EQ(complaint_about("1 0 0\n"), "targets.txt:1: vertex 1: the line ends too early");
  EXPECT_EQ(complaint_about("1 0 0 0\nx 0 0 0\n"), "targets.txt:2: \"x\" is not a whole number");
  EXPECT_EQ(complaint_about("1 0 nan 0\n"),
            "targets.txt:1: vertex 1: \"nan\" is not a finite number");
  EXPECT_EQ(complaint_about("1 0 0 0 0\n"),
            "targets.txt:1: vertex 1: \"0\" is more than belongs on this line");
  EXPECT_EQ(complaint_about("# none\n"),
            "targets.txt: lists no vertex; allowed: lines \"number x y z\"");
}

}  // namespace
}  // namespace supple
