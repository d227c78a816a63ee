// What a picture costs, as a whole and by stage. Limit for the whole: 200,000 triangles at
// 1280×720, with the PNG, in 0.5 s.
#include <benchmark/benchmark.h>

#include "io/picture/ambient_occlusion.h"
#include "io/picture/contact_shadow.h"
#include "io/picture/painter.h"
#include "io/picture/smooth_corners.h"
#include "tests/support/shapes.h"
#include "tests/support/temporary_folder.h"

namespace supple {
namespace {

/// A torus of about as many vertices as the benchmark's argument says, twice as many triangles.
Mesh torus(benchmark::State& state) {
  const int across = static_cast<int>(std::sqrt(state.range(0) / 2.5));
  return make_torus(1, 0.4, static_cast<int>(state.range(0)) / across, across);
}

void render_and_write(benchmark::State& state) {
  const TemporaryFolder folder;
  const Mesh mesh = torus(state);
  for (auto _ : state) {
    const Picture picture = render({{.mesh = &mesh}});
    if (picture.width != 1280 || picture.height != 720) state.SkipWithError("not 1280x720");
    write_png(picture, folder / "picture.png");
  }
  state.counters["png_bytes"] =
      static_cast<double>(std::filesystem::file_size(folder / "picture.png"));
}

/// Limit: 100,000 splats in 0.5 s.
void render_splats(benchmark::State& state) {
  Mesh cloud = torus(state);
  const SmoothCorners corners = smooth_corners(cloud.positions, triangles_of(cloud), 180);
  cloud.normals.values.resize(cloud.positions.rows(), 3);
  for (std::size_t k = 0; k < corners.vertex.size(); ++k)
    cloud.normals.values.row(corners.vertex[k]) = corners.normal[k].normalized().transpose();
  cloud.face_starts = {0};
  cloud.face_vertices.clear();
  for (auto _ : state) benchmark::DoNotOptimize(render({{.mesh = &cloud}}));
}

void prepare(benchmark::State& state) {
  const Mesh mesh = torus(state);
  for (auto _ : state) benchmark::DoNotOptimize(make_drawing({.mesh = &mesh}));
}

void open_context(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(std::make_unique<Painter>(1280, 720));
}

/// What the stages share: a shape that is ready to draw and the view of it.
struct Scene {
  explicit Scene(benchmark::State& state) : mesh(torus(state)) {}

  Mesh mesh;
  std::vector<Drawing> drawings{make_drawing({.mesh = &mesh})};
  View view = fit_view(drawings, {}, 0);
};

void draw(benchmark::State& state) {
  const Scene scene(state);
  const Painter painter(1280, 720);
  for (auto _ : state) {
    painter.draw_shape(scene.drawings[0], scene.view, {.column = 0, .ground_shadow = true});
    benchmark::DoNotOptimize(painter.depth(scene.view));
    benchmark::DoNotOptimize(painter.picture());
  }
}

void ground_shadow(benchmark::State& state) {
  const Scene scene(state);
  const GroundRect rect = ground_below(scene.drawings[0], scene.view);
  for (auto _ : state)
    benchmark::DoNotOptimize(contact_shadow(scene.drawings[0], rect, scene.view));
}

void hollows(benchmark::State& state) {
  const Scene scene(state);
  const Painter painter(1280, 720);
  painter.draw_shape(scene.drawings[0], scene.view, {.column = 0, .ground_shadow = false});
  const std::vector<float> depth = painter.depth(scene.view);
  Picture picture = painter.picture();
  for (auto _ : state) shade_hollows(depth, picture);
}

void png(benchmark::State& state) {
  const TemporaryFolder folder;
  const Mesh mesh = torus(state);
  const Picture picture = render({{.mesh = &mesh}});
  for (auto _ : state) write_png(picture, folder / "picture.png");
}

BENCHMARK(render_and_write)
    ->Arg(10'000)
    ->Arg(100'000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(render_splats)->Arg(100'000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(prepare)->Arg(100'000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(open_context)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(draw)->Arg(100'000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(ground_shadow)->Arg(100'000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(hollows)->Arg(100'000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(png)->Arg(100'000)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace supple
