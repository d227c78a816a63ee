#pragma once

#include <limits>
#include <queue>
#include <vector>

#include "modeler/domain/inside_graph.h"

namespace supple {

/// Shortest ways inside a region from some places to the seats of its pockets, any-angle: straight
/// but for turns at seats (lazy Theta*, Nash et al. 2010). Meant to be reused from place to place.
class InsideWays {
 public:
  /// A way that runs straight from its last turn to a seat.
  struct Way {
    double length = std::numeric_limits<double>::infinity();  ///< [m]
    double to_turn = 0;         ///< length up to the last turn; 0 where it is the start [m]
    Vec3 turn = Vec3::Zero();   ///< last turn
    double turn_clearance = 0;  ///< of it to the boundary, or less [m]
    int start = -1;             ///< the caller's number of where it begins

    bool found() const { return start >= 0; }
    bool straight() const { return to_turn == 0; }
    /// Length if the last part ran on to x.
    double length_to(const Vec3& x) const { return to_turn + (turn - x).norm(); }
  };

  /// Ways stay in a ball, and are no longer than `longest`.
  struct Bounds {
    Vec3 center = Vec3::Zero();
    double radius = std::numeric_limits<double>::infinity();
    double longest = std::numeric_limits<double>::infinity();
  };

  /// `graph` outlives the ways.
  explicit InsideWays(const InsideGraph& graph);

  /// Forgets all ways.
  void clear();

  /// A straight way to the seat of a pocket, known to stay inside.
  void begin(int pocket, const Way& way);

  /// Finds the ways to all pockets within bounds.
  void walk(const Bounds& bounds);

  const Way& to(int pocket) const { return ways_[pocket]; }

 private:
  struct Step {
    Way way;
    int pocket;
    bool seen;  ///< that the last part stays inside
    bool operator<(const Step& other) const {
      return way.length != other.way.length ? way.length > other.way.length : pocket > other.pocket;
    }
  };

  Way by_neighbors(int pocket) const;
  void settle(const Step& step, const Bounds& bounds);

  const InsideGraph& graph_;
  std::vector<Way> ways_;
  std::vector<double> tried_;  ///< shortest way put on the queue
  std::vector<int> touched_;
  std::priority_queue<Step> queue_;
};

}  // namespace supple
