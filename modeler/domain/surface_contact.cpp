#include "modeler/domain/surface_contact.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>

#include "modeler/domain/surface_measures.h"
#include "solver/core/parallel.h"
#include "solver/core/random.h"

namespace supple {

namespace {

constexpr Index samples = 1000;

enum class Contact : char { none, own, other, idle };

/// Points spread over triangles by their area.
class AreaSampler {
 public:
  AreaSampler(const Points& positions, const Triangles& triangles)
      : positions_(positions), triangles_(triangles), areas_(triangles.rows()) {
    double sum = 0;
    for (Index t = 0; t < triangles.rows(); ++t)
      areas_[t] = sum += double_area_normal(positions, triangles, t).norm();
  }

  struct Sample {
    Index triangle;
    Vec3 position, normal;
  };
  Sample sample(Index number) const {
    const double area = (static_cast<double>(number) + 0.5) / samples * areas_.back();
    const auto at = std::upper_bound(areas_.begin(), areas_.end(), area);
    const Index t = std::min<Index>(at - areas_.begin(), triangles_.rows() - 1);
    Random random(static_cast<std::uint64_t>(number));
    double u = random.uniform(), v = random.uniform();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const Vec3 a = positions_.row(triangles_(t, 0)), b = positions_.row(triangles_(t, 1)),
               c = positions_.row(triangles_(t, 2));
    return {t, a + u * (b - a) + v * (c - a), (b - a).cross(c - a).normalized()};
  }

 private:
  const Points& positions_;
  const Triangles& triangles_;
  std::vector<double> areas_;  ///< up to each triangle
};

/// Asks both sides of the surface.
struct Prober {
  const TriangleTree& winding;
  const std::vector<int>& parts;
  double offset, far;

  Contact contact(const AreaSampler::Sample& sample, Index number) const {
    const Vec3 above = sample.position + offset * sample.normal;
    const double inside = winding.winding_number(sample.position - offset * sample.normal);
    if (inside <= 0.5) return Contact::idle;
    if (inside < 1.5 && winding.winding_number(above) <= 0.5) return Contact::none;
    const Vec3 way = Random(static_cast<std::uint64_t>(number)).in_cube(-1, 1).normalized();
    const std::vector<int> about = parts_about(winding, parts, above, above + far * way);
    const int part = parts[static_cast<std::size_t>(sample.triangle)];
    const bool own = std::find(about.begin(), about.end(), part) != about.end();
    return own ? Contact::own : Contact::other;
  }
};

}  // namespace

SurfaceContact measure_contact(const TriangleTree& winding, const Points& positions,
                               const Triangles& triangles, const std::vector<int>& parts,
                               double offset) {
  if (triangles.rows() == 0) return {};
  const AreaSampler sampler(positions, triangles);
  const Prober prober{winding, parts, offset, 2 * box_of_corners(positions, triangles).diagonal()};
  std::vector<Contact> contacts(samples, Contact::none);
  parallel_chunks(samples, 50, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i)
      contacts[static_cast<std::size_t>(i)] = prober.contact(sampler.sample(i), i);
  });
  const auto share = [&](Contact contact) {
    return std::count(contacts.begin(), contacts.end(), contact) / double{samples};
  };
  return {share(Contact::own), share(Contact::other), share(Contact::idle)};
}

std::vector<int> parts_about(const TriangleTree& winding, const std::vector<int>& parts,
                             const Vec3& x, const Vec3& far) {
  std::vector<Crossing> crossings;
  winding.crossings(x, far, crossings);
  std::map<int, int> exits;
  for (const Crossing& crossing : crossings)
    exits[parts[static_cast<std::size_t>(crossing.triangle)]] += crossing.outward ? 1 : -1;
  std::vector<int> about;
  for (const auto& [part, count] : exits)
    if (count > 0) about.push_back(part);
  return about;
}

}  // namespace supple
