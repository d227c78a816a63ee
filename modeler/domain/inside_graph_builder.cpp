#include <algorithm>
#include <numeric>
#include <tuple>

#include "modeler/domain/disjoint_sets.h"
#include "modeler/domain/inside_graph.h"
#include "solver/core/parallel.h"

namespace supple {
namespace {

constexpr Index points_a_chunk = 64, cells_a_chunk = 16;

/// Stations of one cell farther apart are tied by others, in units of the cell's width.
constexpr double longest_tie = 0.9;

/// Pairs of stations that are asked before two pockets count as parted.
constexpr std::size_t most_tries = 8;

struct Pair {
  double squared_distance;
  int a, b;
  bool operator<(const Pair& other) const {
    return std::tie(squared_distance, a, b) < std::tie(other.squared_distance, other.a, other.b);
  }
};

}  // namespace

/// Fills a graph, step by step.
class InsideGraph::Builder {
 public:
  explicit Builder(InsideGraph& graph) : graph_(graph) {}

  void sort_stations(const VolumeSamples& samples) {
    const Index count = samples.positions.rows();
    std::vector<std::pair<std::uint64_t, Index>> order(static_cast<std::size_t>(count));
    for (Index i = 0; i < count; ++i)
      order[i] = {key_of(graph_.cell_at(samples.positions.row(i).transpose())), i};
    std::sort(order.begin(), order.end());
    graph_.stations_.resize(count, 3);
    graph_.volumes_.resize(count);
    for (Index i = 0; i < count; ++i) {
      graph_.stations_.row(i) = samples.positions.row(order[i].second);
      graph_.volumes_[i] = samples.volumes[order[i].second];
      if (i == 0 || order[i].first != order[i - 1].first) {
        CellEntry& entry = add_cell(graph_.cell_at(graph_.stations_.row(i).transpose()));
        entry.first_station = static_cast<int>(i);
      }
      ++graph_.cells_.back().station_count;
    }
    graph_.clearances_.resize(count);
    graph_.layers_.resize(static_cast<std::size_t>(count));
    parallel_chunks(count, points_a_chunk, [&](Index begin, Index end) {
      for (Index i = begin; i < end; ++i) {
        const Vec3 x = graph_.stations_.row(i).transpose();
        graph_.clearances_[i] = graph_.region_.clearance(x);
        graph_.layers_[i] = graph_.region_.layers(x);
      }
    });
  }

  void part_cells() {
    const Index count = static_cast<Index>(graph_.cells_.size());
    std::vector<std::vector<Pocket>> parts(graph_.cells_.size());
    parallel_chunks(count, cells_a_chunk, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) parts[c] = part(graph_.cells_[c]);
    });
    for (Index c = 0; c < count; ++c) {
      graph_.cells_[c].first_pocket = static_cast<int>(graph_.pockets_.size());
      graph_.cells_[c].pocket_count = static_cast<int>(parts[c].size());
      graph_.pockets_.insert(graph_.pockets_.end(), parts[c].begin(), parts[c].end());
    }
    graph_.seated_ = static_cast<int>(graph_.pockets_.size());
  }

  void link_pockets() {
    const Index count = static_cast<Index>(graph_.cells_.size());
    std::vector<std::vector<std::pair<int, int>>> found(graph_.cells_.size());
    parallel_chunks(count, cells_a_chunk, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) link(graph_.cells_[c], found[c]);
    });
    links_.resize(graph_.pockets_.size());
    for (const auto& pairs : found)
      for (const auto& [a, b] : pairs) {
        links_[a].push_back(b);
        links_[b].push_back(a);
      }
  }

  /// Pockets for the parts of cells that the region touches between the stations of cells around.
  void add_slivers(const std::vector<RegionCell>& touched) {
    const std::size_t seated_cells = graph_.cells_.size();
    for (const RegionCell& cell : touched) {
      const GridCell place = graph_.cell_at(cell.center);
      if (!graph_.find(place)) add_cell(place);
    }
    std::sort(graph_.cells_.begin() + static_cast<std::ptrdiff_t>(seated_cells),
              graph_.cells_.end(),
              [](const CellEntry& a, const CellEntry& b) { return a.cell < b.cell; });
    for (std::size_t c = seated_cells; c < graph_.cells_.size(); ++c)
      graph_.cell_numbers_[key_of(graph_.cells_[c].cell)] = static_cast<int>(c);
    slivers_beside_.resize(static_cast<std::size_t>(graph_.seated_));
    for (CellEntry& entry : graph_.cells_) add_slivers_in(entry);
    link_slivers();
  }

  void finish() {
    graph_.link_starts_ = {0};
    for (const std::vector<int>& links : links_) {
      graph_.links_.insert(graph_.links_.end(), links.begin(), links.end());
      graph_.link_starts_.push_back(static_cast<int>(graph_.links_.size()));
    }
    for (CellEntry& entry : graph_.cells_) find_only_pocket(entry);
  }

 private:
  CellEntry& add_cell(const GridCell& cell) {
    graph_.cell_numbers_.emplace(key_of(cell), static_cast<int>(graph_.cells_.size()));
    return graph_.cells_.emplace_back(CellEntry{.cell = cell});
  }

  bool see(int a, int b) const {
    return graph_.sees(a, graph_.stations_.row(b).transpose(), graph_.clearances_[b]);
  }

  double squared_distance(int a, int b) const {
    return (graph_.stations_.row(a) - graph_.stations_.row(b)).squaredNorm();
  }

  /// The pockets of a cell; its stations are put in their order.
  std::vector<Pocket> part(const CellEntry& entry) {
    const int count = entry.station_count, first = entry.first_station;
    DisjointSets sets(count);
    const double reach2 = std::pow(longest_tie * graph_.width_, 2);
    std::vector<Pair> pairs;
    for (int a = 0; a < count; ++a)
      for (int b = a + 1; b < count; ++b)
        if (const double d2 = squared_distance(first + a, first + b); d2 <= reach2)
          pairs.push_back({d2, a, b});
    std::sort(pairs.begin(), pairs.end());
    int parts = count;
    for (const Pair& pair : pairs) {
      if (parts == 1) break;
      if (sets.root(pair.a) == sets.root(pair.b) || !see(first + pair.a, first + pair.b)) continue;
      sets.unite(pair.a, pair.b);
      --parts;
    }
    std::vector<int> order(static_cast<std::size_t>(count));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return sets.root(a) < sets.root(b); });
    reorder(first, order);
    std::vector<Pocket> pockets;
    for (int i = 0; i < count; ++i) {
      if (i == 0 || sets.root(order[i]) != sets.root(order[i - 1]))
        pockets.push_back({entry.cell, first + i});
      ++pockets.back().station_count;
    }
    for (Pocket& pocket : pockets) pocket.seat = middle_station(pocket);
    return pockets;
  }

  void reorder(int first, const std::vector<int>& order) {
    const Index count = static_cast<Index>(order.size());
    const Points stations = graph_.stations_.middleRows(first, count);
    const Eigen::VectorXd volumes = graph_.volumes_.segment(first, count);
    const Eigen::VectorXd clearances = graph_.clearances_.segment(first, count);
    const std::vector<int> layers(graph_.layers_.begin() + first,
                                  graph_.layers_.begin() + first + count);
    for (Index i = 0; i < count; ++i) {
      graph_.stations_.row(first + i) = stations.row(order[i]);
      graph_.volumes_[first + i] = volumes[order[i]];
      graph_.clearances_[first + i] = clearances[order[i]];
      graph_.layers_[first + i] = layers[order[i]];
    }
  }

  int middle_station(const Pocket& pocket) const {
    const auto rows = graph_.stations_.middleRows(pocket.first_station, pocket.station_count);
    const Eigen::RowVector3d middle = rows.colwise().mean();
    Index nearest;
    (rows.rowwise() - middle).rowwise().squaredNorm().minCoeff(&nearest);
    return pocket.first_station + static_cast<int>(nearest);
  }

  void link(const CellEntry& entry, std::vector<std::pair<int, int>>& found) const {
    for (int offset = no_offset + 1; offset < offsets; ++offset) {
      const CellEntry* other = graph_.find(around(entry.cell, offset));
      if (!other) continue;
      for (int a = entry.first_pocket; a < entry.first_pocket + entry.pocket_count; ++a)
        for (int b = other->first_pocket; b < other->first_pocket + other->pocket_count; ++b)
          if (hang_together(graph_.pockets_[a], graph_.pockets_[b])) found.emplace_back(a, b);
    }
  }

  bool hang_together(const Pocket& p, const Pocket& q) const {
    std::vector<Pair> pairs;
    for (int a = p.first_station; a < p.first_station + p.station_count; ++a)
      for (int b = q.first_station; b < q.first_station + q.station_count; ++b)
        pairs.push_back({squared_distance(a, b), a, b});
    const auto tried = pairs.begin() + std::min(most_tries, pairs.size());
    std::partial_sort(pairs.begin(), tried, pairs.end());
    return std::any_of(pairs.begin(), tried, [&](const Pair& pair) { return see(pair.a, pair.b); });
  }

  bool linked(int a, int b) const {
    return std::find(links_[a].begin(), links_[a].end(), b) != links_[a].end();
  }

  bool linked_into(int pocket, const CellEntry& entry) const {
    return std::any_of(links_[pocket].begin(), links_[pocket].end(),
                       [&](int other) { return graph_.pockets_[other].cell == entry.cell; });
  }

  /// A sliver for each set of pockets around that hang together and end at this cell.
  void add_slivers_in(CellEntry& entry) {
    std::vector<int> beside_it;
    for (int offset = 0; offset < offsets; ++offset) {
      if (offset == no_offset) continue;
      const auto [begin, end] = graph_.pockets_in(around(entry.cell, offset));
      for (int pocket = begin; pocket < end; ++pocket)
        if (!linked_into(pocket, entry)) beside_it.push_back(pocket);
    }
    entry.first_sliver = static_cast<int>(graph_.pockets_.size());
    const int count = static_cast<int>(beside_it.size());
    DisjointSets sets(count);
    for (int a = 0; a < count; ++a)
      for (int b = a + 1; b < count; ++b)
        if (linked(beside_it[a], beside_it[b])) sets.unite(a, b);
    for (int root = 0; root < count; ++root) {
      if (sets.root(root) != root) continue;
      const int sliver = static_cast<int>(graph_.pockets_.size());
      graph_.pockets_.push_back({entry.cell});
      ++entry.sliver_count;
      std::vector<int>& links = links_.emplace_back();
      for (int a = 0; a < count; ++a) {
        if (sets.root(a) != root) continue;
        links.push_back(beside_it[a]);
        slivers_beside_[beside_it[a]].push_back(sliver);
      }
    }
  }

  /// Slivers beside one pocket hang together.
  void link_slivers() {
    for (const std::vector<int>& slivers : slivers_beside_)
      for (std::size_t a = 0; a < slivers.size(); ++a)
        for (std::size_t b = a + 1; b < slivers.size(); ++b)
          if (!linked(slivers[a], slivers[b]) && adjoin(slivers[a], slivers[b]))
            links_[slivers[a]].push_back(slivers[b]);
  }

  bool adjoin(int a, int b) const {
    for (int k = 0; k < 3; ++k)
      if (std::abs(graph_.pockets_[a].cell[k] - graph_.pockets_[b].cell[k]) > 1) return false;
    return true;
  }

  /// Where a cell has one pocket, and all around it hang together with that.
  void find_only_pocket(CellEntry& entry) const {
    if (entry.pocket_count + entry.sliver_count != 1) return;
    const int pocket = entry.pocket_count == 1 ? entry.first_pocket : entry.first_sliver;
    for (int offset = 0; offset < offsets; ++offset) {
      if (offset == no_offset) continue;
      const auto [begin, end] = graph_.pockets_in(around(entry.cell, offset));
      for (int other = begin; other < end; ++other)
        if (!linked(pocket, other)) return;
    }
    entry.only = pocket;
  }

  InsideGraph& graph_;
  std::vector<std::vector<int>> links_;           ///< of each pocket
  std::vector<std::vector<int>> slivers_beside_;  ///< each seated pocket
};

InsideGraph::InsideGraph(const Region& region, const VolumeSamples& samples)
    : region_(region),
      // Cells of the grid hold eight of the samples' cells each.
      width_(4 * samples.cells.front().half_width),
      origin_(samples.cells.front().center - Vec3::Constant(samples.cells.front().half_width)) {
  Builder builder(*this);
  builder.sort_stations(samples);
  builder.part_cells();
  builder.link_pockets();
  builder.add_slivers(samples.cells);
  builder.finish();
}

}  // namespace supple
