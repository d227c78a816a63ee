#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "modeler/domain/grid_cell.h"
#include "modeler/domain/volume_samples.h"
#include "solver/core/rest_shape.h"

namespace supple {

/// What hangs together of a region within one cell of a grid: a gap cuts a cell into several,
/// however thin it is (duplicated cells, Nesme et al. 2009).
struct Pocket {
  GridCell cell;
  int first_station = 0, station_count = 0;  ///< none in a sliver between stations
  int seat = -1;                             ///< the station in its middle
};

/// How a region hangs together inside: its volume samples as stations, gathered into pockets of a
/// grid twice as wide as theirs. Pockets in neighbouring cells are linked where one sees the other.
class InsideGraph {
 public:
  /// `region` outlives the graph.
  InsideGraph(const Region& region, const VolumeSamples& samples);

  double width() const { return width_; }  ///< of a cell [m]
  Vec3 corner(const GridCell& cell) const;
  GridCell cell_at(const Vec3& x) const;

  const Points& stations() const { return stations_; }
  const Eigen::VectorXd& volumes() const { return volumes_; }  ///< of the stations [m³]

  /// Those with stations come first.
  const std::vector<Pocket>& pockets() const { return pockets_; }
  int seated() const { return seated_; }  ///< how many pockets have stations
  Vec3 seat(int pocket) const { return stations_.row(pockets_[pocket].seat).transpose(); }
  double seat_clearance(int pocket) const { return clearances_[pockets_[pocket].seat]; }

  /// The pockets in the 26 cells around that hang together with this one. A seated pocket does
  /// not name those without stations.
  std::span<const int> linked(int pocket) const;

  /// Seated pockets of a cell, as a range.
  std::pair<int, int> pockets_in(const GridCell& cell) const;

  /// True where some cell is cut by a gap, or has a neighbour that it does not hang together with.
  bool parted() const;

  /// The pocket that x, inside or on the boundary, belongs to; −1 far from the region.
  int pocket_of(const Vec3& x) const;

  /// The same, of those with stations: for a place between them one that it is beside.
  int seated_pocket_of(const Vec3& x) const;

  /// True where the straight way from a station to x inside stays inside. `clearance` of x to the
  /// boundary, or less [m].
  bool sees(int station, const Vec3& x, double clearance) const;

 private:
  class Builder;

  struct CellEntry {
    GridCell cell;
    int first_station = 0, station_count = 0;
    int first_pocket = 0, pocket_count = 0;  ///< seated
    int first_sliver = 0, sliver_count = 0;  ///< without stations
    int only = -1;                           ///< the pocket of all its points
  };

  struct View {
    double squared_distance;
    int station, pocket;
    bool operator<(const View& other) const {
      return squared_distance != other.squared_distance ? squared_distance < other.squared_distance
                                                        : station < other.station;
    }
  };

  const CellEntry* find(const GridCell& cell) const;
  void add_views(const Vec3& x, const GridCell& cell, std::vector<View>& views) const;
  int seen_from(const Vec3& x, std::vector<View>& views, std::size_t most) const;
  int seen_pocket(const Vec3& x, const GridCell& cell) const;
  int within(const GridCell& cell, int pocket) const;

  const Region& region_;
  double width_;
  Vec3 origin_;
  Points stations_;
  Eigen::VectorXd volumes_, clearances_;
  std::vector<int> layers_;  ///< of the region, at stations
  std::vector<Pocket> pockets_;
  int seated_ = 0;
  std::vector<int> link_starts_, links_;
  std::vector<CellEntry> cells_;
  std::unordered_map<std::uint64_t, int> cell_numbers_;
};

}  // namespace supple
