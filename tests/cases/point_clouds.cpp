#include "tests/support/point_clouds.h"

#include <cmath>

#include "modeler/domain/mesh_region.h"
#include "modeler/domain/point_region.h"
#include "modeler/domain/shape_error.h"
#include "tests/cases/cases.h"

namespace supple {
namespace {

/// Volume of what is inside one of both only, over the mesh's.
double difference_percent(const Region& region, const Region& mesh) {
  const Box box = mesh.bounds();
  Random random(17);
  int inside = 0, differ = 0;
  for (int i = 0; i < 40000; ++i) {
    const Vec3 x = box.center() + 0.55 * random.in_cube(-1, 1).cwiseProduct(box.size());
    const bool expected = mesh.contains(x);
    inside += expected ? 1 : 0;
    differ += region.contains(x) != expected ? 1 : 0;
  }
  return 100.0 * differ / inside;
}

double refused(const Points& positions) {
  try {
    PointRegion region(positions);
  } catch (const ShapeError&) {
    return 1;
  }
  return 0;
}

void measure_spoilt_clouds(Figures& figures) {
  const Mesh torus = of_unit_size(make_torus(0.3, 0.12, 96, 48));
  const MeshRegion mesh(torus.positions, triangles_of(torus));
  const Index count = 10000;
  const Points clean = points_on(torus, count).positions;
  const Points noisy = with_noise(clean, 0.01);
  figures["clean"] = difference_percent(PointRegion(clean), mesh);
  figures["noise"] = difference_percent(PointRegion(noisy), mesh);
  figures["outliers"] = difference_percent(PointRegion(with_outliers(clean, count / 10)), mesh);
  figures["both"] = difference_percent(PointRegion(with_outliers(noisy, count / 10)), mesh);
  figures["one_point_refused"] = refused(clean.topRows(1));
  figures["three_points_refused"] = refused(clean.topRows(3));
}

constexpr Case cases[] = {{"B11", measure_spoilt_clouds}};

}  // namespace

std::span<const Case> point_cloud_cases() {
  return cases;
}

}  // namespace supple
