#include <cstdint>

#include "io/mesh/mesh_formats.h"
#include "io/points/point_formats.h"
#include "tests/fuzz/check_fuzzed_mesh.h"

/// The first byte chooses the reader: '0' OBJ, '1' OFF, '2' PLY, '3' STL, '4' PCD, '5' PWN, '6'
/// XYZ.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace supple;
  constexpr Mesh (*readers[])(const FileBytes&) = {read_obj, read_off, read_ply, read_stl,
                                                   read_pcd, read_pwn, read_xyz};
  if (size < 2) return 0;
  const std::size_t choice = static_cast<std::size_t>(data[0] - '0') % std::size(readers);
  check_fuzzed_mesh(readers[choice], {data + 1, size - 1});
  return 0;
}
