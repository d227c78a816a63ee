#include <Eigen/Geometry>
#include <cstdint>

#include "io/mesh/binary_output.h"
#include "io/mesh/mesh_formats.h"

namespace supple {
namespace {

constexpr std::size_t title_bytes = 80;

/// As the file holds it. One number at a time: g++ 12 at -O3 leaves out the rounding of whole
/// vectors that go to single precision and straight back.
Vec3 rounded(const Mesh& mesh, int vertex) {
  Vec3 x;
  for (int axis = 0; axis < 3; ++axis) {
    const volatile float single = static_cast<float>(mesh.positions(vertex, axis));
    x[axis] = single;
  }
  return x;
}

}  // namespace

void write_stl(const Mesh& mesh, OutputFile& file) {
  if (mesh.face_count() == 0)
    throw OutputError(fmt::format("{}: cannot write: STL holds triangles, this is a point cloud",
                                  file.path().string()));
  const Triangles triangles = triangulate(mesh).triangles;
  std::string bytes = "binary STL by Supple";  // must not begin with "solid"
  bytes.resize(title_bytes, ' ');
  append_binary(bytes, static_cast<std::uint32_t>(triangles.rows()));
  const auto append = [&](const Vec3& vector) {
    for (int axis = 0; axis < 3; ++axis) append_binary(bytes, checked_float(vector[axis], file));
  };
  for (Index t = 0; t < triangles.rows(); ++t) {
    // Rounded first, so that a reader's own normals are the same.
    const Vec3 a = rounded(mesh, triangles(t, 0));
    const Vec3 b = rounded(mesh, triangles(t, 1));
    const Vec3 c = rounded(mesh, triangles(t, 2));
    append((b - a).stableNormalized().cross((c - a).stableNormalized()).stableNormalized());
    append(a);
    append(b);
    append(c);
    append_binary(bytes, std::uint16_t{0});
    file.write(bytes);
    bytes.clear();
  }
}

}  // namespace supple
