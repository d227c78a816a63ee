#include "io/unfinished.h"

#include <array>
#include <atomic>

#include <unistd.h>

namespace supple {
namespace {

// A signal handler can reach nothing but what is static and without locks.
constexpr int slots = 32;
std::array<std::atomic<const char*>, slots> paths{};

/// A free place for `path`; `slots` where there is none.
int take_slot(const char* path) {
  for (int slot = 0; slot < slots; ++slot) {
    const char* free = nullptr;
    if (paths[static_cast<std::size_t>(slot)].compare_exchange_strong(free, path)) return slot;
  }
  return slots;
}

}  // namespace

Unfinished::Unfinished(const char* path) : slot_(take_slot(path)) {}
Unfinished::~Unfinished() {
  if (slot_ < slots) paths[static_cast<std::size_t>(slot_)] = nullptr;
}

void Unfinished::remove_all() noexcept {
  for (const std::atomic<const char*>& held : paths) {
    const char* path = held;
    if (path && ::unlink(path) != 0) ::rmdir(path);
  }
}

}  // namespace supple
