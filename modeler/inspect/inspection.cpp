#include "modeler/inspect/inspection.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "io/errors.h"
#include "modeler/domain/select.h"
#include "modeler/domain/shape_error.h"
#include "modeler/domain/surface_samples.h"
#include "solver/core/stopwatch.h"

namespace supple {
namespace {

constexpr double thickness_samples = 2000;
constexpr double mark_width = 0.01;  // of the diagonal, between the samples of a selected part

/// Runs the stages and books their time.
class Stages {
 public:
  Stages(const OnStage& on_stage, Inspection& inspection)
      : on_stage_(on_stage), inspection_(inspection) {}

  template <class Work>
  void run(const std::string& name, const Work& work) {
    if (on_stage_) on_stage_(name);
    const Stopwatch watch;
    work();
    inspection_.seconds.emplace_back(name, watch.seconds());
  }

 private:
  const OnStage& on_stage_;
  Inspection& inspection_;
};

SolidVerdict judge(const Mesh& mesh, const ShapeSpec& spec) {
  SolidVerdict verdict;
  try {
    verdict.solid = std::make_unique<Solid>(mesh, spec);
  } catch (const ShapeError& error) {
    verdict.reason = error.what();
  }
  return verdict;
}

/// About `count` of a solid's surface samples, evenly over the surface.
SurfaceSamples few_samples(const Solid& solid, double count) {
  const SurfaceSamples& all = solid.surface();
  const Index step = 1 + all.size() / static_cast<Index>(20 * count);
  std::vector<int> numbers;
  for (Index k = 0; k < all.size(); k += step) numbers.push_back(static_cast<int>(k));
  const ThinnedSamples thinned = thin_samples(all, numbers, std::sqrt(all.areas.sum() / count));
  return {all.positions(thinned.indices, Eigen::all), thinned.areas, {}, {}};
}

ThinParts find_thin_parts(const Solid& solid) {
  const SurfaceSamples samples = few_samples(solid, thickness_samples);
  ThinParts thin{
      measure_thickness(solid.region(), samples.positions, samples.areas).scaled(solid.unit()),
      static_cast<long>(solid.particles_placed()), solid.particles().spacing * solid.unit()};
  thin.thinner_share = thin.thickness.share_below(thin.spacing);
  thin.wanted_spacing = std::min(thin.spacing, thin.thickness.quantile(most_thin_share));
  thin.wanted_particles =
      static_cast<double>(thin.particles) * std::pow(thin.spacing / thin.wanted_spacing, 3);
  return thin;
}

/// Each triangle's corners, or each point of a cloud.
SurfaceSamples corner_samples(const Mesh& mesh, const Triangulation& cut) {
  SurfaceSamples samples;
  if (mesh.face_count() == 0) {
    samples.vertices.resize(static_cast<std::size_t>(mesh.positions.rows()));
    std::iota(samples.vertices.begin(), samples.vertices.end(), 0);
    samples.triangles.assign(samples.vertices.size(), -1);
  } else {
    const auto corners = cut.triangles.reshaped<Eigen::RowMajor>();
    samples.vertices.assign(corners.begin(), corners.end());
    for (std::size_t k = 0; k < samples.vertices.size(); ++k)
      samples.triangles.push_back(static_cast<int>(k / 3));
  }
  samples.positions = mesh.positions(samples.vertices, Eigen::all);
  samples.areas = Eigen::VectorXd::Ones(samples.size());
  return samples;
}

/// What a selection of the shape counts: as a pose counts it for a cloud, finely for a mesh.
SurfaceSamples selectable_samples(const Mesh& mesh, const Triangulation& cut,
                                  const Inspection& inspection, const SurfaceSamples& corners) {
  if (mesh.face_count() > 0)
    return sample_surface(mesh.positions, cut.triangles, mark_width * inspection.box.diagonal());
  SurfaceSamples samples = corners;
  if (const auto& solid = inspection.verdict.solid) {
    samples = solid->surface();
    samples.positions = solid->restored(samples.positions);
  }
  const double area = inspection.points->area;  // none of a single point
  if (area > 0) samples.areas *= area / samples.areas.sum();
  return samples;
}

/// Different vertices among the corners that `selection` holds; often none where faces are large.
long count_vertices(const Selection& selection, const SelectionContext& context,
                    const SurfaceSamples& corners) {
  try {
    std::vector<int> vertices;
    for (const int k : select(selection, context, corners)) vertices.push_back(corners.vertices[k]);
    std::sort(vertices.begin(), vertices.end());
    return std::unique(vertices.begin(), vertices.end()) - vertices.begin();
  } catch (const UsageError&) {
    return 0;
  }
}

}  // namespace

Inspection inspect(const Mesh& mesh, const ShapeSpec& spec, const OnStage& on_stage) {
  Inspection inspection;
  Stages stages(on_stage, inspection);
  stages.run("survey", [&] {
    if (mesh.face_count() > 0)
      inspection.box = inspection.mesh.emplace(survey_mesh(mesh)).box;
    else {
      inspection.points = measure_spacing(mesh.positions);
      inspection.box = bounding_box(mesh.positions);
    }
  });
  stages.run("fill", [&] { inspection.verdict = judge(mesh, spec); });
  if (!inspection.verdict.poses()) return inspection;
  inspection.box = inspection.verdict.solid->box();
  stages.run("thickness", [&] { inspection.thin = find_thin_parts(*inspection.verdict.solid); });
  return inspection;
}

SelectedPart select_part(const Mesh& mesh, const Inspection& inspection, const Selection& selection,
                         const std::filesystem::path& folder) {
  const Triangulation cut = triangulate(mesh);
  const SelectionContext context{mesh, cut, inspection.box, folder};
  const SurfaceSamples corners = corner_samples(mesh, cut);
  const SurfaceSamples samples = selectable_samples(mesh, cut, inspection, corners);

  SelectedPart part;
  const std::vector<int> chosen = select(selection, context, samples);
  for (const int k : chosen) {
    part.area += samples.areas[k];
    part.box.extend(samples.positions.row(k).transpose());
  }
  part.area_share = part.area / samples.areas.sum();
  part.vertices = count_vertices(selection, context, corners);
  part.samples = samples.positions(
      thin_samples(samples, chosen, mark_width * inspection.box.diagonal()).indices, Eigen::all);
  return part;
}

}  // namespace supple
