#pragma once

#include <cstdint>
#include <span>

#include "io/scene/scene.h"

namespace supple {

/// 64 bits that tell one text from another (FNV-1a), from the hash of what stands before it.
std::uint64_t hash_bytes(std::span<const std::byte> bytes,
                         std::uint64_t before = 0xcbf29ce484222325);

/// Of every value of the scene as the program understands it, comments and order of keys apart.
std::uint64_t scene_hash(const Scene& scene);

}  // namespace supple
