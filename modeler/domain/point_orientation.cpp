#include "modeler/domain/point_orientation.h"

#include <tuple>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/mst_orient_normals.h>
#include <CGAL/property_map.h>

namespace supple {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using OrientedPoint = std::tuple<Kernel::Point_3, Kernel::Vector_3, int>;

}  // namespace

std::vector<int> orient_normals(const Points& positions, int neighbors, int most_parts,
                                Points& normals) {
  std::vector<OrientedPoint> points;
  points.reserve(static_cast<std::size_t>(positions.rows()));
  for (Index i = 0; i < positions.rows(); ++i)
    points.emplace_back(Kernel::Point_3(positions(i, 0), positions(i, 1), positions(i, 2)),
                        Kernel::Vector_3(normals(i, 0), normals(i, 1), normals(i, 2)),
                        static_cast<int>(i));
  const auto how = CGAL::parameters::point_map(CGAL::Nth_of_tuple_property_map<0, OrientedPoint>())
                       .normal_map(CGAL::Nth_of_tuple_property_map<1, OrientedPoint>());

  std::vector<int> parts(points.size(), -1);
  std::vector<OrientedPoint> rest = std::move(points);
  for (int part = 0; part < most_parts && !rest.empty(); ++part) {
    const auto end = CGAL::mst_orient_normals(rest, static_cast<unsigned>(neighbors), how);
    for (auto point = rest.begin(); point != end; ++point) {
      const auto& [position, normal, i] = *point;
      normals.row(i) << normal.x(), normal.y(), normal.z();
      parts[static_cast<std::size_t>(i)] = part;
    }
    rest.erase(rest.begin(), end);
  }
  return parts;
}

}  // namespace supple
