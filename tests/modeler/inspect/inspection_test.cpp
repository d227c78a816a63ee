#include "modeler/inspect/inspection.h"

#include <gtest/gtest.h>

#include "io/errors.h"
#include "tests/support/region_shapes.h"

namespace supple {
namespace {

ShapeSpec with_particles(int count) {
  ShapeSpec spec;
  spec.particles = count;
  return spec;
}

SelectedPart part_of(const Mesh& mesh, const std::string& selection) {
  return select_part(mesh, inspect(mesh, {}), parse_selection(selection, {"test"}), {});
}

TEST(Inspection, ABallPosesAndIsNowhereThin) {
  const Inspection ball = inspect(make_icosphere(10, 3), {});
  ASSERT_TRUE(ball.verdict.poses());
  ASSERT_TRUE(ball.thin);
  EXPECT_NEAR(ball.thin->thickness.quantile(0.5), 20, 0.3);
  EXPECT_EQ(ball.thin->particles, 200);
  EXPECT_EQ(ball.thin->thinner_share, 0);
  EXPECT_EQ(ball.thin->wanted_spacing, ball.thin->spacing);
}

TEST(Inspection, ASlabIsThinnerThanItsParticlesAndSaysHowManyFollow) {
  const Mesh slab = make_bar({2, 0.1, 2}, {10, 1, 10});
  const Inspection coarse = inspect(slab, with_particles(100));
  ASSERT_TRUE(coarse.thin);
  EXPECT_GT(coarse.thin->spacing, 0.12);
  EXPECT_GT(coarse.thin->thinner_share, 0.85);
  EXPECT_NEAR(coarse.thin->wanted_spacing, 0.1, 0.002);
  const Inspection fine = inspect(slab, with_particles(int(coarse.thin->wanted_particles) + 20));
  EXPECT_LT(fine.thin->thinner_share, most_thin_share);
}

TEST(Inspection, WhatCannotBePosedSaysWhy) {
  const Mesh sheet = make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const Inspection inspection = inspect(sheet, {});
  EXPECT_FALSE(inspection.verdict.poses());
  EXPECT_GT(inspection.verdict.reason.size(), 10u);
  EXPECT_FALSE(inspection.thin);
}

TEST(Inspection, OfAPointCloudTellsItsSpacing) {
  Mesh cloud = make_icosphere(1, 3);
  cloud.face_vertices.clear();
  cloud.face_starts = {0};
  const Inspection inspection = inspect(cloud, {});
  EXPECT_FALSE(inspection.mesh);
  ASSERT_TRUE(inspection.points);
  EXPECT_NEAR(inspection.points->area, 4 * std::numbers::pi, 1.5);
  EXPECT_NEAR(inspection.box.diagonal(), 2 * std::sqrt(3.0), 0.05);
  EXPECT_NEAR(part_of(cloud, "y>50%").area_share, 0.5, 0.05);
}

TEST(Inspection, ASelectionHasVerticesAreaAndBox) {
  const Mesh bar = make_bar({1, 4, 1}, {2, 8, 2});
  const SelectedPart end = part_of(bar, "y>=90%");
  EXPECT_EQ(end.vertices, 9);
  EXPECT_NEAR(end.area, 1 + 4 * 0.4, 0.06);
  EXPECT_NEAR(end.area_share, end.area / 18, 1e-6);
  EXPECT_NEAR(end.box.upper.y(), 4, 1e-9);
  EXPECT_GE(end.box.lower.y(), 3.6);
  EXPECT_GT(end.samples.rows(), 100);

  EXPECT_EQ(part_of(bar, "y>40% and y<45%").vertices, 0) << "between two rings of vertices";
  EXPECT_THROW(part_of(bar, "y>200%"), UsageError);
}

TEST(Inspection, TellsItsStages) {
  std::vector<std::string> stages;
  const Inspection inspection =
      inspect(make_icosphere(1, 2), {}, [&](const std::string& stage) { stages.push_back(stage); });
  EXPECT_EQ(stages, (std::vector<std::string>{"survey", "fill", "thickness"}));
  EXPECT_EQ(inspection.seconds.size(), 3u);
}

}  // namespace
}  // namespace supple
