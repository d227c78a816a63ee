#include "modeler/domain/inside_cover.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "modeler/domain/inside_ways.h"
#include "modeler/domain/point_blocks.h"

namespace supple {
namespace {

constexpr double farthest = 1.5;  // of the spacing

/// A particle whose cell holds no station still has some volume.
constexpr double least_volume = 1e-3;  // of the stations' mean

class Cover {
 public:
  Cover(const InsideGraph& graph, Particles& particles)
      : graph_(graph), particles_(particles), ways_(graph) {
    for (Index i = 0; i < particles_.size(); ++i) {
      const int pocket = graph_.seated_pocket_of(particles_.positions.row(i).transpose());
      if (pocket >= 0) begin(static_cast<int>(i), pocket);
    }
    ways_.walk({});
  }

  int add_particles() {
    int added = 0;
    for (int pocket = farthest_pocket(); ways_.to(pocket).length > farthest * particles_.spacing;
         pocket = farthest_pocket()) {
      particles_.positions.conservativeResize(particles_.size() + 1, 3);
      particles_.positions.bottomRows(1) = graph_.seat(pocket).transpose();
      begin(static_cast<int>(particles_.size()) - 1, pocket);
      ways_.walk({});
      ++added;
    }
    return added;
  }

  /// The particle that each station belongs to: the nearest, where the station sees it. Returns
  /// how many do not.
  long assign(std::vector<int>& owners) const {
    owners = PointBlocks(graph_.stations()).nearest_sites(particles_.positions).sites;
    long hidden = 0;
    for (int pocket = 0; pocket < graph_.seated(); ++pocket) {
      const Pocket& of = graph_.pockets()[pocket];
      for (int station = of.first_station; station < of.first_station + of.station_count; ++station)
        if (owners[station] != ways_.to(pocket).start && !sees_owner(station, owners[station])) {
          owners[station] = ways_.to(pocket).start;
          ++hidden;
        }
    }
    return hidden;
  }

  void share_volumes(const std::vector<int>& owners) {
    const double total = particles_.volumes.sum();
    Eigen::VectorXd volumes = Eigen::VectorXd::Zero(particles_.size());
    for (Index k = 0; k < graph_.volumes().size(); ++k) volumes[owners[k]] += graph_.volumes()[k];
    volumes = volumes.cwiseMax(least_volume * graph_.volumes().mean());
    particles_.volumes = volumes * (total / volumes.sum());
  }

 private:
  void begin(int particle, int pocket) {
    const Vec3 x = particles_.positions.row(particle).transpose();
    ways_.begin(pocket, {(graph_.seat(pocket) - x).norm(), 0, x, 0, particle});
  }

  bool sees_owner(int station, int owner) const {
    return graph_.sees(station, particles_.positions.row(owner).transpose(), 0);
  }

  int farthest_pocket() const {
    int result = 0;
    for (int pocket = 1; pocket < graph_.seated(); ++pocket)
      if (ways_.to(pocket).length > ways_.to(result).length) result = pocket;
    return result;
  }

  const InsideGraph& graph_;
  Particles& particles_;
  InsideWays ways_;
};

}  // namespace

InsideCover cover_inside(const InsideGraph& graph, Particles& particles) {
  Cover cover(graph, particles);
  const int added = cover.add_particles();
  std::vector<int> owners;
  const long hidden = cover.assign(owners);
  if (added > 0 || hidden > 0) cover.share_volumes(owners);
  return {added};
}

}  // namespace supple
