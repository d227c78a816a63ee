#include "modeler/domain/pocket_spline.h"

#include <algorithm>
#include <tuple>

#include "modeler/domain/disjoint_sets.h"

namespace supple {
namespace {

constexpr int count = PocketSpline::controls_a_pocket;

GridCell step_of(int control) {
  return {control % 3 - 1, control / 3 % 3 - 1, control / 9 - 1};
}

/// Number of the control that lies `step` cells away; −1 beyond those of the pocket.
int control_at(const GridCell& step) {
  for (const int s : step)
    if (s < -1 || s > 1) return -1;
  return step[0] + 1 + 3 * (step[1] + 1) + 9 * (step[2] + 1);
}

/// How far a control is from its pocket's cell, in cells, squared.
int squared_steps(int control) {
  const GridCell step = step_of(control);
  return step[0] * step[0] + step[1] * step[1] + step[2] * step[2];
}

}  // namespace

PocketSpline::PocketSpline(const InsideGraph& graph) : graph_(graph) {
  share_controls();
  choose_speakers();
}

void PocketSpline::share_controls() {
  const int pockets = static_cast<int>(graph_.pockets().size());
  DisjointSets sets(count * pockets);
  for (int p = 0; p < pockets; ++p)
    for (const int q : graph_.linked(p)) {
      if (p < q && q < graph_.seated()) continue;  // named by both
      const GridCell &from = graph_.pockets()[p].cell, &to = graph_.pockets()[q].cell;
      for (int control = 0; control < count; ++control) {
        const GridCell step = step_of(control);
        const int same = control_at(
            {step[0] + from[0] - to[0], step[1] + from[1] - to[1], step[2] + from[2] - to[2]});
        if (same >= 0) sets.unite(count * p + control, count * q + same);
      }
    }
  controls_.resize(static_cast<std::size_t>(pockets));
  for (int p = 0; p < pockets; ++p)
    for (int control = 0; control < count; ++control) {
      const int id = count * p + control, root = sets.root(id);
      if (root == id) {
        controls_[p][control] = size();
        const GridCell &cell = graph_.pockets()[p].cell, step = step_of(control);
        places_.push_back(graph_.corner({cell[0] + step[0], cell[1] + step[1], cell[2] + step[2]}) +
                          Vec3::Constant(0.5 * graph_.width()));
      } else {
        controls_[p][control] = controls_[root / count][root % count];
      }
    }
}

/// Of all pockets that share a control, the nearest speak for it; slivers do by a pocket beside
/// them, where no other does.
void PocketSpline::choose_speakers() {
  constexpr int farthest = 100, of_sliver = 10;
  std::vector<int> nearest(places_.size(), farthest);
  const auto distance = [&](int p, int control) {
    return squared_steps(control) + (p < graph_.seated() ? 0 : of_sliver);
  };
  const int pockets = static_cast<int>(controls_.size());
  for (int p = 0; p < pockets; ++p)
    for (int control = 0; control < count; ++control)
      nearest[controls_[p][control]] =
          std::min(nearest[controls_[p][control]], distance(p, control));
  std::vector<std::pair<int, int>> speakers;
  for (int p = 0; p < pockets; ++p)
    for (int control = 0; control < count; ++control)
      if (nearest[controls_[p][control]] == distance(p, control))
        speakers.emplace_back(p < graph_.seated() ? p : graph_.linked(p).front(),
                              controls_[p][control]);
  std::sort(speakers.begin(), speakers.end());
  speakers.erase(std::unique(speakers.begin(), speakers.end()), speakers.end());
  spoken_starts_.assign(static_cast<std::size_t>(graph_.seated()) + 1, 0);
  for (const auto& [pocket, control] : speakers) {
    spoken_.push_back(control);
    ++spoken_starts_[pocket + 1];
  }
  for (std::size_t p = 1; p < spoken_starts_.size(); ++p)
    spoken_starts_[p] += spoken_starts_[p - 1];
}

std::span<const int> PocketSpline::spoken_for(int pocket) const {
  return {spoken_.data() + spoken_starts_[pocket], spoken_.data() + spoken_starts_[pocket + 1]};
}

PocketSpline::Basis PocketSpline::basis(int pocket, const Vec3& x) const {
  const double width = graph_.width();
  const Vec3 place = (x - graph_.corner(graph_.pockets()[pocket].cell)) / width;
  Basis basis;
  for (int axis = 0; axis < 3; ++axis) {
    const double u = place[axis];
    basis[axis] = {Vec3(0.5 * (1 - u) * (1 - u), 0.5 + u * (1 - u), 0.5 * u * u),
                   Vec3(u - 1, 1 - 2 * u, u) / width, Vec3(1, -2, 1) / (width * width)};
  }
  return basis;
}

PocketSpline::Value PocketSpline::sum(const Basis& basis, Values values, Derivatives derivatives) {
  // Along x first, for each derivative by x: (y, z).
  std::array<Mat3, 3> by_x;
  for (int d = 0; d <= static_cast<int>(derivatives); ++d)
    for (int z = 0; z < 3; ++z)
      for (int y = 0; y < 3; ++y) {
        const float* row = &values[static_cast<std::size_t>(9 * z + 3 * y)];
        by_x[d](y, z) = basis[0][d][0] * row[0] + basis[0][d][1] * row[1] + basis[0][d][2] * row[2];
      }
  const auto all = [&](int dx, int dy, int dz) {
    return basis[1][dy].dot(by_x[dx] * basis[2][dz]);
  };
  Value sum;
  sum.value = all(0, 0, 0);
  if (derivatives >= Derivatives::first) sum.slope = {all(1, 0, 0), all(0, 1, 0), all(0, 0, 1)};
  if (derivatives == Derivatives::second) {
    sum.curvature.diagonal() << all(2, 0, 0), all(0, 2, 0), all(0, 0, 2);
    sum.curvature(0, 1) = sum.curvature(1, 0) = all(1, 1, 0);
    sum.curvature(0, 2) = sum.curvature(2, 0) = all(1, 0, 1);
    sum.curvature(1, 2) = sum.curvature(2, 1) = all(0, 1, 1);
  }
  return sum;
}

}  // namespace supple
