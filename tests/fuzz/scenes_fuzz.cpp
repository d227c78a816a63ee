#include <cstdint>
#include <string>

#include "io/errors.h"
#include "io/scene/scene_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    supple::read_scene_text(std::string(data, data + size), "fuzzed.yaml", "/no/such/folder");
  } catch (const supple::UsageError&) {
  }
  return 0;
}
