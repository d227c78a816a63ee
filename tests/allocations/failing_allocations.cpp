// Preloaded into a program, it makes its allocations fail, counted from main on:
//   SUPPLE_FAIL_AT=n        the n-th (from 1)
//   SUPPLE_FAIL_FROM=n      the n-th and all after it
//   SUPPLE_COUNT_INTO=FILE  how many there were
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>

#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include "tests/allocations/c_library_malloc.h"

namespace {

std::atomic<long> allocations{0};
std::atomic<bool> counting{false};
long fail_at = 0, fail_from = 0;

bool fails() {
  if (!counting) return false;
  const long number = ++allocations;
  const bool fails = number == fail_at || (fail_from > 0 && number >= fail_from);
  if (fails) errno = ENOMEM;
  return fails;
}

long number_in(const char* variable) {
  const char* text = std::getenv(variable);
  return text ? std::atol(text) : 0;
}

using Main = int (*)(int, char**, char**);
Main program_main = nullptr;

int counted_main(int count, char** words, char** variables) {
  fail_at = number_in("SUPPLE_FAIL_AT");
  fail_from = number_in("SUPPLE_FAIL_FROM");
  counting = true;
  const int code = program_main(count, words, variables);
  counting = false;
  if (const char* file = std::getenv("SUPPLE_COUNT_INTO")) {
    const int descriptor = ::open(file, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dprintf(descriptor, "%ld", allocations.load());
    ::close(descriptor);
  }
  return code;
}

}  // namespace

extern "C" {
void* malloc(std::size_t size) {
  return fails() ? nullptr : __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  return fails() ? nullptr : __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
  return fails() ? nullptr : __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return fails() ? nullptr : __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  void* block = aligned_alloc(alignment, size);
  if (!block) return ENOMEM;
  *memory = block;
  return 0;
}

int __libc_start_main(Main main, int count, char** words, void (*init)(), void (*fini)(),
                      void (*loader_fini)(), void* stack_end) {
  using Start = decltype(&__libc_start_main);
  program_main = main;
  const auto start = reinterpret_cast<Start>(::dlsym(RTLD_NEXT, "__libc_start_main"));
  return start(counted_main, count, words, init, fini, loader_fini, stack_end);
}
}
