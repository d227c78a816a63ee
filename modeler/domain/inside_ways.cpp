#include "modeler/domain/inside_ways.h"

#include <algorithm>

namespace supple {

InsideWays::InsideWays(const InsideGraph& graph)
    : graph_(graph),
      ways_(static_cast<std::size_t>(graph.seated())),
      tried_(ways_.size(), std::numeric_limits<double>::infinity()) {}

void InsideWays::clear() {
  for (const int pocket : touched_) {
    ways_[pocket] = {};
    tried_[pocket] = std::numeric_limits<double>::infinity();
  }
  touched_.clear();
  queue_ = {};
}

void InsideWays::begin(int pocket, const Way& way) {
  if (!(way.length < tried_[pocket])) return;
  touched_.push_back(pocket);
  tried_[pocket] = way.length;
  queue_.push({way, pocket, true});
}

void InsideWays::walk(const Bounds& bounds) {
  while (!queue_.empty()) {
    Step step = queue_.top();
    queue_.pop();
    if (!(step.way.length < ways_[step.pocket].length)) continue;
    if (!step.seen &&
        !graph_.sees(graph_.pockets()[step.pocket].seat, step.way.turn, step.way.turn_clearance)) {
      step.way = by_neighbors(step.pocket);
      step.seen = true;
      if (!(step.way.length < ways_[step.pocket].length)) continue;
      if (!queue_.empty() && queue_.top().way.length < step.way.length) {
        queue_.push(step);
        continue;
      }
    }
    settle(step, bounds);
  }
}

/// The best way with a turn at the seat of a pocket beside this one.
InsideWays::Way InsideWays::by_neighbors(int pocket) const {
  Way best;
  for (const int other : graph_.linked(pocket)) {
    const Way& way = ways_[other];
    if (!way.found()) continue;
    const double length = way.length + (graph_.seat(other) - graph_.seat(pocket)).norm();
    if (length < best.length)
      best = {length, way.length, graph_.seat(other), graph_.seat_clearance(other), way.start};
  }
  return best;
}

void InsideWays::settle(const Step& step, const Bounds& bounds) {
  ways_[step.pocket] = step.way;
  for (const int other : graph_.linked(step.pocket)) {
    const Vec3 seat = graph_.seat(other);
    const double length = step.way.length_to(seat);
    if (!(length < tried_[other])) continue;
    if (length > bounds.longest || (seat - bounds.center).norm() > bounds.radius) continue;
    if (tried_[other] == std::numeric_limits<double>::infinity()) touched_.push_back(other);
    tried_[other] = length;
    Way way = step.way;
    way.length = length;
    queue_.push({way, other, false});
  }
}

}  // namespace supple
