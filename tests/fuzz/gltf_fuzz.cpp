#include <cstdint>

#include "io/gltf/gltf_formats.h"
#include "tests/fuzz/check_fuzzed_mesh.h"

/// What was read can be written.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace supple;
  if (size == 0) return 0;
  const std::optional<Mesh> mesh = check_fuzzed_mesh(read_gltf, {data, size});
  if (!mesh || mesh->positions.rows() > 10'000) return 0;
  OutputFile file("/dev/null");
  try {
    write_glb(*mesh, file);
  } catch (const OutputError&) {  // numbers beyond float32
  }
  return 0;
}
