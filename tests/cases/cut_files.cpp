#include "tests/support/cut_files.h"

#include <algorithm>

#include "io/errors.h"
#include "io/scene/scene_reader.h"
#include "solver/core/random.h"
#include "tests/cases/cases.h"

namespace supple {
namespace {

/// The beginnings of `sample` of these lengths that read_mesh takes for all of it in silence.
int silent_cuts(const SampleFile& sample, const std::vector<std::size_t>& lengths) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.put(sample.name, sample.bytes);
  const Mesh whole = read_mesh(path);
  return static_cast<int>(std::count_if(lengths.begin(), lengths.end(), [&](std::size_t length) {
    folder.put(sample.name, sample.bytes);
    return fate_of_cut(path, sample, whole, length) == CutFate::silent;
  }));
}

/// A sphere of 2562 vertices, as large as files of that kind are at their smallest.
int silent_random_cuts(Random& random) {
  const Mesh sphere = make_icosphere(1, 4);
  int silent = 0;
  for (const char* name : {"a.obj", "a.off", "a.ply", "a.stl", "a.pcd", "a.xyz"}) {
    const SampleFile sample{name, written(sphere, name),
                            std::string_view(name) != "a.obj" && std::string_view(name) != "a.xyz"};
    std::vector<std::size_t> lengths;
    for (int cut = 0; cut < 20; ++cut) lengths.push_back(random.next() % sample.bytes.size());
    silent += silent_cuts(sample, lengths);
  }
  return silent;
}

const std::string whole_scene =
    "supple: 1\nshape:\n  mesh: 'bar.obj'\n  particles: 60\n  units: \"mm\"\npose:\n"
    "  weights: {rigidity: 2, volume: 10}\n  handles:\n    - fix: y<10%\n"
    "    - move: {and: [y>90%, \"box(0,0,0,1,1,1)\"]}\n      by: [10%, 0, 0]\n"
    "      turn: {axis: [0, 0, 1], degrees: 30}\n  no_inversion: true\n";

/// The beginnings of a scene that are refused without a place.
int cut_scenes_without_place(int& refused) {
  int without_place = 0;
  for (std::size_t length = 0; length < whole_scene.size(); ++length) try {
      read_scene_text(whole_scene.substr(0, length), "s.yaml", "");
    } catch (const UsageError& error) {
      ++refused;
      without_place += !std::string(error.what()).starts_with("s.yaml:");
    }
  return without_place;
}

void measure_cut_files(Figures& figures) {
  int silent = 0, refused = 0;
  for (const SampleFile& sample : sample_files()) {
    std::vector<std::size_t> lengths(sample.bytes.size());
    for (std::size_t length = 0; length < lengths.size(); ++length) lengths[length] = length;
    silent += silent_cuts(sample, lengths);
  }
  Random random(3);
  figures["silent"] = silent;
  figures["silent_large"] = silent_random_cuts(random);
  figures["scenes_without_place"] = cut_scenes_without_place(refused);
  figures["scenes_refused"] = refused / static_cast<double>(whole_scene.size());
}

constexpr Case cases[] = {{"K3", measure_cut_files}};

}  // namespace

std::span<const Case> cut_file_cases() {
  return cases;
}

}  // namespace supple
