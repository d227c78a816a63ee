// Bars made in code, and the models of Botsch and Sorkine's survey where they are at hand, posed by
// Supple and beside it by CGAL's as-rigid-as-possible deformation: a picture, a table and, of every
// model, the mesh and a scene that `supple pose` runs.
//   beside_arap FOLDER [SURVEY_FOLDER]
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "io/mesh/mesh_files.h"
#include "io/output_file.h"
#include "io/picture/picture.h"
#include "io/scene/scene_reader.h"
#include "modeler/domain/shape_error.h"
#include "modeler/domain/surface_measures.h"
#include "modeler/pose/handles.h"
#include "modeler/pose/pose.h"
#include "solver/core/stopwatch.h"
#include "tests/bench/references/as_rigid_as_possible.h"
#include "tests/support/shapes.h"

namespace supple::bench {
namespace {

namespace fs = std::filesystem;

/// Steps in which CGAL's controls are led, iterations in each, and iterations at the end.
constexpr int steps = 18, iterations = 5, last_iterations = 200;

constexpr double degree = std::numbers::pi / 180;

struct Model {
  std::string name, label;
  Mesh mesh;
  std::vector<int> fixed, led;  ///< vertices
  HandlePath path;              ///< of what is led
};

/// How one program posed a model.
struct Posed {
  Mesh mesh;
  double seconds = 0;
  double volume_change = 0;  ///< V/V0 − 1 of the surface
  double edge_change = 0;    ///< rms of l/l0 − 1
};

std::vector<int> vertices_of(const Mesh& mesh, const std::function<bool(const Vec3&)>& chosen) {
  std::vector<int> vertices;
  for (Index i = 0; i < mesh.positions.rows(); ++i)
    if (chosen(mesh.positions.row(i).transpose())) vertices.push_back(static_cast<int>(i));
  return vertices;
}

/// A bar 1:1:5 held at its lower tenth and led at its upper one.
Model bar(const std::string& name, const std::string& label, const HandlePath& path) {
  Model model{name, label, make_bar({1, 1, 5}, {12, 12, 60}), {}, {}, path};
  model.fixed = vertices_of(model.mesh, [](const Vec3& x) { return x.z() < 0.5 + 1e-9; });
  model.led = vertices_of(model.mesh, [](const Vec3& x) { return x.z() > 4.5 - 1e-9; });
  return model;
}

std::vector<Model> bars() {
  HandlePath bend, twist, squeeze;
  // Its middle line becomes half a circle between the ends.
  bend.about = Vec3(0.5 + 4 / std::numbers::pi, 0.5, 2.5);
  bend.axis = Vec3::UnitY();
  bend.radians = 180 * degree;
  twist.about = Vec3(0.5, 0.5, 4.75);
  twist.radians = 180 * degree;
  squeeze.by = Vec3(0, 0, -1);
  return {bar("bent", "bent by 180 degrees", bend), bar("twisted", "twisted by 180 degrees", twist),
          bar("squeezed", "squeezed by 20 %", squeeze)};
}

/// The numbers of a file with comments behind #.
std::vector<double> numbers_in(const fs::path& file) {
  std::ifstream in(file);
  std::vector<double> numbers;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    for (double number = 0; words >> number;) numbers.push_back(number);
  }
  return numbers;
}

/// NAME.off, NAME.sel (0 fixed, 1 free, 2 led, a vertex each) and NAME.def (a matrix, row by row).
Model survey_model(const fs::path& folder, const std::string& name, const std::string& label) {
  Model model{name, label, read_mesh(folder / (name + ".off")), {}, {}, {}};
  const std::vector<double> parts = numbers_in(folder / (name + ".sel"));
  const std::vector<double> matrix = numbers_in(folder / (name + ".def"));
  if (static_cast<Index>(parts.size()) != model.mesh.positions.rows() || matrix.size() != 16)
    throw std::runtime_error(fmt::format("{}: no such model of the survey", name));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i] == 0) model.fixed.push_back(static_cast<int>(i));
    if (parts[i] == 2) model.led.push_back(static_cast<int>(i));
  }
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> motion(matrix.data());
  const Eigen::AngleAxisd turn(motion.topLeftCorner<3, 3>());
  const Vec3 about = model.mesh.positions(model.led, Eigen::all).colwise().mean().transpose();
  model.path.about = about;
  model.path.axis = turn.axis();
  model.path.radians = turn.angle();
  model.path.by = motion.topLeftCorner<3, 3>() * about + motion.topRightCorner<3, 1>() - about;
  return model;
}

std::vector<Model> survey(const fs::path& folder) {
  return {survey_model(folder, "survey_bar", "twisted by 135 degrees"),
          survey_model(folder, "survey_cactus", "bent by 70 degrees"),
          survey_model(folder, "survey_cylinder", "bent by 120 degrees"),
          survey_model(folder, "survey_plane", "lifted")};
}

std::string list_of(const Vec3& x) {
  return fmt::format("[{}, {}, {}]", x[0], x[1], x[2]);
}

void write_text(const std::string& text, const fs::path& path) {
  OutputFile file(path);
  file.write(text);
  file.commit();
}

void write_list(const std::vector<int>& vertices, const fs::path& file) {
  write_text(fmt::format("{}\n", fmt::join(vertices, "\n")), file);
}

/// The model's files; returns its scene's.
fs::path write_scene(const Model& model, const fs::path& folder) {
  const fs::path base = folder / model.name;
  write_mesh(model.mesh, base.string() + ".off");
  write_list(model.fixed, base.string() + "_fixed.txt");
  write_list(model.led, base.string() + "_led.txt");
  const fs::path scene = base.string() + ".yaml";
  write_text(
      fmt::format("shape: {{mesh: {0}.off, particles: 400}}\npose:\n  weights: {{volume: 10}}\n"
                  "  hard_handles: true\n  no_inversion: true\n  handles:\n    - fix: "
                  "vertices({0}_fixed.txt)\n"
                  "    - move: vertices({0}_led.txt)\n      by: {1}\n"
                  "      turn: {{axis: {2}, degrees: {3}, about: {4}}}\n",
                  model.name, list_of(model.path.by), list_of(model.path.axis),
                  model.path.radians / degree, list_of(model.path.about)),
      scene);
  return scene;
}

double edge_change(const Points& rest, const Points& posed, const Triangles& triangles) {
  std::set<std::pair<int, int>> edges;
  for (Index f = 0; f < triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      edges.insert(std::minmax(triangles(f, k), triangles(f, (k + 1) % 3)));
  double sum = 0;
  for (const auto& [a, b] : edges) {
    const double before = (rest.row(a) - rest.row(b)).norm();
    if (before > 0) sum += std::pow((posed.row(a) - posed.row(b)).norm() / before - 1, 2);
  }
  return std::sqrt(sum / static_cast<double>(edges.size()));
}

void measure(const Model& model, Posed& posed) {
  const Triangles triangles = triangulate(model.mesh).triangles;
  // Open models are closed to their middle.
  const Eigen::RowVector3d middle = model.mesh.positions.colwise().mean();
  const auto volume = [&](const Points& positions) {
    return signed_volume(positions.rowwise() - middle, triangles);
  };
  posed.volume_change = volume(posed.mesh.positions) / volume(model.mesh.positions) - 1;
  posed.edge_change = edge_change(model.mesh.positions, posed.mesh.positions, triangles);
}

Posed pose_by_supple(const Model& model, const fs::path& scene) {
  const Stopwatch watch;
  PoseResult result = pose(model.mesh, read_scene(scene));
  Posed posed{std::move(result.mesh), watch.seconds()};
  std::printf("%s: %s, least det F %.3g\n", model.name.c_str(),
              std::string(enum_name(result.report.status)).c_str(), result.min_det_F);
  for (const Reason& reason : result.report.reasons) std::printf("  %s\n", reason.detail.c_str());
  measure(model, posed);
  return posed;
}

Posed pose_by_cgal(const Model& model) {
  std::vector<int> controls = model.fixed;
  controls.insert(controls.end(), model.led.begin(), model.led.end());
  const Stopwatch watch;
  AsRigidAsPossible cgal(model.mesh.positions, triangulate(model.mesh).triangles, controls);
  Points targets = model.mesh.positions(controls, Eigen::all);
  for (int step = 1; step <= steps; ++step) {
    for (std::size_t k = model.fixed.size(); k < controls.size(); ++k)
      targets.row(static_cast<Index>(k)) =
          model.path(model.mesh.positions.row(controls[k]).transpose(), double(step) / steps)
              .transpose();
    cgal.deform(targets, step < steps ? iterations : last_iterations);
  }
  Posed posed{model.mesh, watch.seconds()};
  posed.mesh.positions = cgal.positions();
  measure(model, posed);
  return posed;
}

std::string percent(double share) {
  return fmt::format("{:+.1f} %", 100 * share);
}

/// Upright and of one size, so that models of any size stand beside each other.
Mesh for_picture(Mesh mesh, const Mesh& rest) {
  const auto box = rest.positions.colwise();
  const Eigen::RowVector3d lower = box.minCoeff(), upper = box.maxCoeff();
  mesh.positions = (mesh.positions.rowwise() - 0.5 * (lower + upper)) / (upper - lower).norm();
  return mesh;
}

/// One picture above the other.
Picture stacked(const Picture& above, const Picture& below) {
  Picture both{above.width, above.height + below.height, above.rgb};
  both.rgb.insert(both.rgb.end(), below.rgb.begin(), below.rgb.end());
  return both;
}

Picture row_of(const std::vector<Mesh>& meshes, const std::vector<std::string>& labels) {
  std::vector<PictureItem> items;
  for (std::size_t k = 0; k < meshes.size(); ++k)
    items.push_back({.mesh = &meshes[k], .label = labels[k]});
  PictureOptions options;
  options.width = 320 * static_cast<int>(meshes.size());
  options.height = 400;
  options.camera.zoom = 1.1;
  options.camera.up = Vec3::UnitZ();
  options.camera.azimuth_deg = -25;
  return render(items, options);
}

void compare(const std::vector<Model>& models, const fs::path& folder) {
  std::vector<Mesh> ours, theirs;
  std::vector<std::string> our_labels, their_labels;
  std::string table =
      "| | vertices | volume, Supple / CGAL | edges, rms, Supple / CGAL | seconds, Supple / CGAL "
      "|\n"
      "|---|---|---|---|---|\n";
  for (const Model& model : models) {
    const fs::path scene = write_scene(model, folder);
    try {
      const Posed mine = pose_by_supple(model, scene), peer = pose_by_cgal(model);
      ours.push_back(for_picture(mine.mesh, model.mesh));
      theirs.push_back(for_picture(peer.mesh, model.mesh));
      our_labels.push_back(fmt::format("Supple: volume {}", percent(mine.volume_change)));
      their_labels.push_back(fmt::format("CGAL: volume {}", percent(peer.volume_change)));
      table +=
          fmt::format("| {}, {} | {} | {} / {} | {:.1f} % / {:.1f} % | {:.2f} / {:.2f} |\n",
                      model.name, model.label, model.mesh.positions.rows(),
                      percent(mine.volume_change), percent(peer.volume_change),
                      100 * mine.edge_change, 100 * peer.edge_change, mine.seconds, peer.seconds);
    } catch (const ShapeError& error) {
      table += fmt::format("| {}, {} | {} | refused: {} | | |\n", model.name, model.label,
                           model.mesh.positions.rows(), error.what());
    }
  }
  write_png(stacked(row_of(ours, our_labels), row_of(theirs, their_labels)),
            folder / "beside_arap.png");
  std::fputs(table.c_str(), stdout);
}

}  // namespace
}  // namespace supple::bench

int main(int count, char** words) {
  using namespace supple::bench;
  if (count < 2 || count > 3) {
    std::fputs("usage: beside_arap FOLDER [SURVEY_FOLDER]\n", stderr);
    return 2;
  }
  try {
    std::filesystem::create_directories(words[1]);
    std::vector<Model> models = bars();
    if (count == 3)
      for (Model& model : survey(words[2])) models.push_back(std::move(model));
    compare(models, words[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "beside_arap: %s\n", error.what());
    return 1;
  }
}
