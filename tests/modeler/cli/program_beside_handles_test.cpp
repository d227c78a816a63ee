// What the command line says of a pose beside its handles.

#include "tests/modeler/cli/program_fixture.h"

namespace supple {
namespace {

TEST_F(ProgramTest, StiffensParts) {
  EXPECT_EQ(
      pose_bar({"--by", "10%,0,0", "--stiffen", "y:40%..60%", "--times", "9", "--report", "r.json"})
          .code,
      0);
  expect_contains(json("r.json")["effects"]["active"]["stiffness"]["because"], "9 times as stiff");
  expect_usage_error(pose_bar({"--stiffen", "y<50%"}), "--times is missing");
  expect_usage_error(pose_bar({"--times", "3"}), "no --stiffen stands before it");
}

TEST_F(ProgramTest, GoesOnFromAnotherPose) {
  EXPECT_EQ(pose_bar({"--by", "10%,0,0"}).code, 0);
  EXPECT_EQ(run({"pose", "bar.obj", "--particles", "60", "--fix", "y<10%", "--move", "y>90%",
                 "--by", "5%,0,0", "--from", "posed.obj", "-o", "further.obj"})
                .code,
            0);
  const Points once = read_mesh(folder / "posed.obj").positions;
  const Points further = read_mesh(folder / "further.obj").positions;
  EXPECT_NEAR((further - once).col(0).maxCoeff(), 0.05 * std::sqrt(1.08), 0.002);
  write_mesh(make_bar({1, 1, 1}, {1, 1, 1}), folder / "other.obj");
  expect_usage_error(pose_bar({"--from", "other.obj"}), "has 8 vertices, the shape 354");
  EXPECT_EQ(pose_bar({"--from", "none.obj"}).code, 3);
}

TEST_F(ProgramTest, MovesNothingOutsideARegion) {
  EXPECT_EQ(run({"pose", "bar.obj", "--particles", "60", "--region", "y>30%", "--region-blend",
                 "8%", "--move", "y>90%", "--by", "10%,0,0", "-o", "posed.obj"})
                .code,
            0);
  const Points rest = read_mesh(folder / "bar.obj").positions;
  const Points posed = read_mesh(folder / "posed.obj").positions;
  for (Index i = 0; i < rest.rows(); ++i)
    EXPECT_TRUE(rest(i, 1) > 0.3 || rest.row(i) == posed.row(i)) << i;
  EXPECT_GT((posed - rest).col(0).maxCoeff(), 0.09);
  expect_usage_error(pose_bar({"--region", "y>30%"}), "'y<10%' lies outside pose.region 'y>30%'");
  expect_usage_error(pose_bar({"--region", "y>300%"}),
                     "supple: --region y>300%: 'y>300%' selects nothing");
  expect_usage_error(pose_bar({"--region", "y"}), "--region y");
  expect_usage_error(pose_bar({"--region-blend", "8%"}), "pose.region is missing");
}

TEST_F(ProgramTest, MirrorsHandles) {
  EXPECT_EQ(run({"pose", "bar.obj", "--particles", "60", "--mirror", "0,1,0", "--fix", "y:45%..55%",
                 "--move", "y>90%", "--by", "10%,0,0", "-o", "posed.obj", "--report", "r.json"})
                .code,
            0);
  EXPECT_EQ(json("r.json")["handles"]["each"].size(), 3u);
  const Points rest = read_mesh(folder / "bar.obj").positions;
  const Points moved = read_mesh(folder / "posed.obj").positions - rest;
  for (Index i = 0; i < rest.rows(); ++i)
    EXPECT_TRUE(std::abs(rest(i, 1) - 0.5) < 0.45 || moved(i, 0) > 0.08) << i;
  expect_usage_error(pose_bar({"--mirror", "0,0,0"}), "--mirror 0,0,0");
  expect_usage_error(pose_bar({"--mirror-at", "0,0,0"}), "pose.mirror.normal is missing");
}

TEST_F(ProgramTest, LeadsVerticesToTheirPlaces) {
  EXPECT_EQ(pose_bar({"--by", "10%,0,0"}).code, 0);
  EXPECT_EQ(run({"pose", "bar.obj", "--particles", "60", "--fix", "y<10%", "--move", "y>90%",
                 "--to", "posed.obj", "-o", "again.obj"})
                .code,
            0);
  const Points difference =
      read_mesh(folder / "again.obj").positions - read_mesh(folder / "posed.obj").positions;
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), 5e-3);
  expect_usage_error(pose_bar({"--by", "1,0,0", "--to", "posed.obj"}), "--by stands beside it");
  folder.put("nose.txt", "0 0 0 0\n999 0 0 0\n");
  const ProgramResult wrong = pose_bar({"--to", "nose.txt"});
  EXPECT_EQ(wrong.code, 3);
  expect_contains(wrong.err, "nose.txt:2: there is no vertex 999");
  folder.put("led.yaml",
             "shape: {mesh: bar.obj, particles: 60}\n"
             "pose: {handles: [{fix: y<10%}, {to: posed.obj}]}\n");
  expect_usage_error(run({"pose", "led.yaml", "-o", "led.obj"}), "led.yaml:2:37: move is missing");
}

}  // namespace
}  // namespace supple
