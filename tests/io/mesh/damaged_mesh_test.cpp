#include <map>

#include <gtest/gtest.h>

#include "io/mesh/mesh_checks.h"
#include "io/mesh/mesh_files.h"
#include "solver/core/random.h"
#include "tests/support/cut_files.h"
#include "tests/support/sample_files.h"

namespace supple {
namespace {

/// Every beginning of a file is refused, noted as cut, or still the whole mesh.
TEST(TruncatedMesh, IsNeverReadInSilence) {
  for (const SampleFile& sample : sample_files()) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.put(sample.name, sample.bytes);
    const Mesh whole = read_mesh(path);
    std::map<CutFate, double> shares;
    for (std::size_t length = sample.bytes.size(); length-- > 0;) {
      const CutFate fate = fate_of_cut(path, sample, whole, length);
      EXPECT_NE(fate, CutFate::silent) << sample.name << " of " << length << " bytes";
      shares[fate] += 1.0 / static_cast<double>(sample.bytes.size());
    }
    if (sample.tells_its_length)
      EXPECT_GT(shares[CutFate::refused], 0.9) << sample.name;
    else
      EXPECT_GT(std::min(shares[CutFate::refused], shares[CutFate::told]), 0.05) << sample.name;
  }
}

/// Some bytes changed: refused, or a mesh that holds together.
void expect_refused_or_whole(const Mesh& mesh, const std::string& name, Random& random) {
  const TemporaryFolder folder;
  const std::string bytes = written(mesh, name);
  int refused = 0, read = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    std::string damaged = bytes;
    for (int change = 0; change <= trial % 3; ++change)
      damaged[random.next() % damaged.size()] = static_cast<char>(random.next());
    try {
      const Mesh part = read_mesh(folder.put(name, damaged));
      check_mesh(part);
      EXPECT_TRUE((triangulate(part).triangles.array() >= 0).all());
      ++read;
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 10) << name;
  EXPECT_GT(read, 10) << name;
}

TEST(MutatedMesh, NeverGivesABrokenMesh) {
  Random random(11);
  for (const char* name : {"a.ply", "a.off", "a.obj", "a.stl"})
    expect_refused_or_whole(colored_box(), name, random);
  for (const char* name : {"a.ply", "a.pcd", "a.pwn", "a.xyz"})
    expect_refused_or_whole(cloud_with_all(), name, random);
}

}  // namespace
}  // namespace supple
