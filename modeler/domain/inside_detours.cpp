#include "modeler/domain/inside_detours.h"

#include <algorithm>
#include <cmath>

#include "modeler/domain/inside_ways.h"
#include "modeler/domain/pocket_spline.h"
#include "solver/core/parallel.h"

namespace supple {
namespace {

constexpr Index particles_a_chunk = 16;

/// Supports that grew once will grow more: they shall not ask again each time.
constexpr double foresight = 1.4;

/// Controls beyond the support count at its rim, but little there: how far they are asked for, in
/// cells.
constexpr double margin = 0.5;

/// Turns lie at seats, not at the boundary: ways are longer than they should by less than this
/// share of the spacing, and as much is left out.
constexpr double slack = 0.03;

/// What a way cannot be found for counts as so many supports long.
constexpr double unreachable = 1.5;

}  // namespace

/// Finds one particle's detours at the controls. Meant to be reused.
class InsideDetours::Finder {
 public:
  Finder(const InsideGraph& graph, const PocketSpline& spline, double slack)
      : graph_(graph),
        spline_(spline),
        slack_(slack),
        ways_(graph),
        sums_(static_cast<std::size_t>(spline.size())),
        counts_(static_cast<std::size_t>(spline.size())) {}

  /// The particle at x, within `radius` [m].
  std::vector<AtControl> find(const Vec3& x, double radius) {
    radius_ = radius;
    x_ = x;
    ways_.clear();
    const int own = graph_.seated_pocket_of(x);
    if (own < 0) return {};
    ways_.begin(own, {(graph_.seat(own) - x).norm(), 0, x, own_clearance(own), 0});
    ways_.walk({x, radius + graph_.width(), 2 * radius});
    list_pockets();
    const bool sees_all = std::all_of(pockets_.begin(), pockets_.end(), [&](int pocket) {
      return ways_.to(pocket).found() && ways_.to(pocket).straight();
    });
    return sees_all ? std::vector<AtControl>() : gather();
  }

 private:
  /// The pockets of the cells around x whose middle is within the radius.
  void list_pockets() {
    pockets_.clear();
    const GridCell lower = graph_.cell_at(x_ - Vec3::Constant(radius_)),
                   upper = graph_.cell_at(x_ + Vec3::Constant(radius_));
    for (int i = lower[0]; i <= upper[0]; ++i)
      for (int j = lower[1]; j <= upper[1]; ++j)
        for (int k = lower[2]; k <= upper[2]; ++k) {
          const Vec3 middle = graph_.corner({i, j, k}) + Vec3::Constant(0.5 * graph_.width());
          if ((middle - x_).squaredNorm() > radius_ * radius_) continue;
          const auto [begin, end] = graph_.pockets_in({i, j, k});
          for (int pocket = begin; pocket < end; ++pocket) pockets_.push_back(pocket);
        }
  }

  /// x's distance to the boundary, or less.
  double own_clearance(int own) const {
    return std::max(0.0, graph_.seat_clearance(own) - (graph_.seat(own) - x_).norm());
  }

  /// Means of what the pockets say of the controls that they speak for.
  std::vector<AtControl> gather() {
    touched_.clear();
    for (const int pocket : pockets_)
      for (const int control : spline_.spoken_for(pocket)) {
        if (counts_[control] == 0) touched_.push_back(control);
        ++counts_[control];
        sums_[control] += detour(pocket, spline_.place(control));
      }
    std::sort(touched_.begin(), touched_.end());
    std::vector<AtControl> lengths;
    for (const int control : touched_) {
      if (sums_[control] > 0) lengths.push_back({control, sums_[control] / counts_[control]});
      sums_[control] = 0;
      counts_[control] = 0;
    }
    return lengths;
  }

  /// δ at a place, by the way to a pocket near it.
  double detour(int pocket, const Vec3& place) const {
    const InsideWays::Way& way = ways_.to(pocket);
    const double most = unreachable * radius_;
    if (!way.found()) return most;
    if (way.straight()) return 0;
    return std::clamp(way.length_to(place) - (place - x_).norm() - slack_, 0.0, most);
  }

  const InsideGraph& graph_;
  const PocketSpline& spline_;
  const double slack_;
  InsideWays ways_;
  Vec3 x_ = Vec3::Zero();
  double radius_ = 0;
  std::vector<int> pockets_;
  std::vector<double> sums_;
  std::vector<int> counts_;
  std::vector<int> touched_;
};

/// All particles' detours, by control.
class InsideDetours::Field final : public Detours {
 public:
  explicit Field(const InsideDetours& owner) : graph_(owner.graph_), spline_(owner.spline_) {
    starts_.assign(static_cast<std::size_t>(spline_->size()) + 1, 0);
    for (const auto& of_particle : owner.lengths_)
      for (const AtControl& at : of_particle) ++starts_[at.control + 1];
    for (std::size_t c = 1; c < starts_.size(); ++c) starts_[c] += starts_[c - 1];
    entries_.resize(static_cast<std::size_t>(starts_.back()));
    std::vector<int> next(starts_.begin(), starts_.end() - 1);
    for (std::size_t i = 0; i < owner.lengths_.size(); ++i)
      for (const AtControl& at : owner.lengths_[i])
        entries_[next[at.control]++] = {static_cast<int>(i), at.length};
    list_particles(owner.positions_, owner.radii_);
  }

  void at(const Vec3& x, std::vector<Detour>& detours) const override {
    detours.clear();
    const int pocket = graph_->pocket_of(x);
    if (pocket < 0 || listed_starts_[pocket] == listed_starts_[pocket + 1]) return;
    for (int k = listed_starts_[pocket]; k < listed_starts_[pocket + 1]; ++k)
      detours.push_back({listed_[k]});
    const PocketSpline::Controls& controls = spline_->controls(pocket);
    const PocketSpline::Weights weights = spline_->weights(pocket, x);
    for (int k = 0; k < PocketSpline::controls_a_pocket; ++k)
      add(controls[k], weights.values[k], weights.slopes[k], weights.curvatures[k], detours);
    std::erase_if(detours, [](const Detour& detour) { return !(detour.length > 0); });
  }

 private:
  struct Entry {
    int particle;
    double length;
  };

  /// The particles of each pocket that any of its controls knows and whose detours may count in
  /// its cell.
  void list_particles(const Points& positions, const Eigen::VectorXd& radii) {
    listed_starts_ = {0};
    const double reach = std::sqrt(0.75) * graph_->width();
    std::vector<int> seen_in(static_cast<std::size_t>(positions.rows()), -1);
    for (int pocket = 0; pocket < static_cast<int>(graph_->pockets().size()); ++pocket) {
      const Vec3 middle =
          graph_->corner(graph_->pockets()[pocket].cell) + Vec3::Constant(0.5 * graph_->width());
      for (const int control : spline_->controls(pocket))
        for (int e = starts_[control]; e < starts_[control + 1]; ++e) {
          const int i = entries_[e].particle;
          if (seen_in[i] == pocket) continue;
          seen_in[i] = pocket;
          if ((positions.row(i).transpose() - middle).norm() < radii[i] + reach)
            listed_.push_back(i);
        }
      std::sort(listed_.begin() + listed_starts_.back(), listed_.end());
      listed_starts_.push_back(static_cast<int>(listed_.size()));
    }
  }

  /// Adds what one control says of the particles listed.
  void add(int control, double value, const Vec3& slope, const Mat3& curvature,
           std::vector<Detour>& detours) const {
    auto detour = detours.begin();
    for (int e = starts_[control]; e < starts_[control + 1]; ++e) {
      const auto [particle, length] = entries_[e];
      while (detour != detours.end() && detour->particle < particle) ++detour;
      if (detour == detours.end()) return;
      if (detour->particle != particle) continue;
      detour->length += length * value;
      detour->slope += length * slope;
      detour->curvature += length * curvature;
    }
  }

  std::shared_ptr<const InsideGraph> graph_;
  std::shared_ptr<const PocketSpline> spline_;
  std::vector<int> starts_;
  std::vector<Entry> entries_;  ///< by control, then particle
  std::vector<int> listed_starts_;
  std::vector<int> listed_;  ///< particles with detours, by pocket
};

InsideDetours::InsideDetours(std::shared_ptr<const InsideGraph> graph, const Points& positions,
                             double spacing)
    : graph_(std::move(graph)),
      spline_(std::make_shared<const PocketSpline>(*graph_)),
      positions_(positions),
      spacing_(spacing),
      radii_(Eigen::VectorXd::Zero(positions.rows())),
      lengths_(static_cast<std::size_t>(positions.rows())) {}

InsideDetours::~InsideDetours() = default;

std::shared_ptr<const Detours> InsideDetours::within(const Eigen::VectorXd& supports,
                                                     double widest) {
  std::vector<int> grown;
  for (Index i = 0; i < supports.size(); ++i)
    if (supports[i] > radii_[i]) {
      grown.push_back(static_cast<int>(i));
      radii_[i] = std::min(widest, (radii_[i] > 0 ? foresight : 1) * supports[i]);
    }
  if (grown.empty()) return latest_;
  parallel_chunks(static_cast<Index>(grown.size()), particles_a_chunk, [&](Index begin, Index end) {
    Finder finder(*graph_, *spline_, slack * spacing_);
    for (Index k = begin; k < end; ++k)
      lengths_[grown[k]] = finder.find(positions_.row(grown[k]).transpose(),
                                       radii_[grown[k]] + margin * graph_->width());
  });
  const bool none = std::all_of(lengths_.begin(), lengths_.end(),
                                [](const auto& of_particle) { return of_particle.empty(); });
  latest_ = none ? nullptr : std::make_shared<const Field>(*this);
  return latest_;
}

}  // namespace supple
