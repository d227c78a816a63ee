#include "modeler/domain/inside_detours.h"

#include <algorithm>
#include <cmath>

#include "modeler/domain/inside_ways.h"
#include "modeler/domain/pocket_spline.h"
#include "solver/core/parallel.h"

namespace supple {
namespace {

constexpr Index particles_a_chunk = 16, pockets_a_chunk = 256;

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

/// What the controls of one pocket say of the particles that have detours there.
struct PocketDetours {
  std::vector<int> particles;  ///< ascending
  std::vector<float> lengths;  ///< 27 a particle

  PocketSpline::Values lengths_of(std::size_t k) const {
    return PocketSpline::Values(&lengths[k * PocketSpline::controls_a_pocket],
                                PocketSpline::controls_a_pocket);
  }
};

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

/// All particles' detours, by pocket.
class InsideDetours::Field final : public Detours {
 public:
  explicit Field(const InsideDetours& owner)
      : graph_(owner.graph_), spline_(owner.spline_), pockets_(graph_->pockets().size()) {
    const ByControl by_control = sorted_by_control(owner.lengths_);
    parallel_chunks(
        static_cast<Index>(pockets_.size()), pockets_a_chunk, [&](Index begin, Index end) {
          std::vector<int> place_of(owner.lengths_.size(), -1);
          for (Index pocket = begin; pocket < end; ++pocket)
            pockets_[pocket] = list(static_cast<int>(pocket), owner, by_control, place_of);
        });
  }

  void at(const Vec3& x, Derivatives derivatives, std::vector<Detour>& detours) const override {
    detours.clear();
    const int pocket = graph_->pocket_of(x);
    if (pocket < 0 || pockets_[pocket].particles.empty()) return;
    const PocketDetours& known = pockets_[pocket];
    const PocketSpline::Basis basis = spline_->basis(pocket, x);
    for (std::size_t k = 0; k < known.particles.size(); ++k) {
      const auto [length, slope, curvature] =
          PocketSpline::sum(basis, known.lengths_of(k), derivatives);
      if (length > 0) detours.push_back({known.particles[k], length, slope, curvature});
    }
  }

 private:
  struct AtParticle {
    int particle;
    double length;
  };
  using ByControl = std::vector<std::vector<AtParticle>>;

  ByControl sorted_by_control(const std::vector<std::vector<AtControl>>& lengths) const {
    ByControl by_control(static_cast<std::size_t>(spline_->size()));
    for (std::size_t i = 0; i < lengths.size(); ++i)
      for (const AtControl& at : lengths[i])
        by_control[at.control].push_back({static_cast<int>(i), at.length});
    return by_control;
  }

  /// The particles that any control of the pocket knows and whose detours may count in its cell.
  /// `place_of` is −1 for all particles, before and after.
  PocketDetours list(int pocket, const InsideDetours& owner, const ByControl& by_control,
                     std::vector<int>& place_of) const {
    const double reach = std::sqrt(0.75) * graph_->width();
    const Vec3 middle =
        graph_->corner(graph_->pockets()[pocket].cell) + Vec3::Constant(0.5 * graph_->width());
    const PocketSpline::Controls& controls = spline_->controls(pocket);
    PocketDetours known;
    for (const int control : controls)
      for (const AtParticle& at : by_control[control])
        if (place_of[at.particle] < 0 &&
            (owner.positions_.row(at.particle).transpose() - middle).norm() <
                owner.radii_[at.particle] + reach) {
          place_of[at.particle] = 0;
          known.particles.push_back(at.particle);
        }
    std::sort(known.particles.begin(), known.particles.end());
    for (std::size_t k = 0; k < known.particles.size(); ++k)
      place_of[known.particles[k]] = static_cast<int>(k);
    known.lengths.resize(known.particles.size() * PocketSpline::controls_a_pocket);
    for (std::size_t c = 0; c < controls.size(); ++c)
      for (const AtParticle& at : by_control[controls[c]])
        if (const int k = place_of[at.particle]; k >= 0)
          known.lengths[static_cast<std::size_t>(k) * PocketSpline::controls_a_pocket + c] =
              static_cast<float>(at.length);
    for (const int particle : known.particles) place_of[particle] = -1;
    return known;
  }

  std::shared_ptr<const InsideGraph> graph_;
  std::shared_ptr<const PocketSpline> spline_;
  std::vector<PocketDetours> pockets_;
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
