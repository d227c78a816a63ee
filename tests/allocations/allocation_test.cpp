// What must not allocate: counted where all allocations of the process come by.
#include <atomic>
#include <cstdlib>

#include <gtest/gtest.h>

#include "modeler/pose/pose_session.h"
#include "solver/core/parallel.h"
#include "tests/allocations/c_library_malloc.h"
#include "tests/support/bar_scene.h"
#include "tests/support/shapes.h"

namespace {

std::atomic<long> allocations{0};

}  // namespace

extern "C" {
void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
  ++allocations;
  return __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
}

namespace supple {
namespace {

TEST(Allocations, AreCounted) {
  const long before = allocations;
  const Points points = Points::Zero(1000, 3);
  EXPECT_EQ(points.norm(), 0);
  EXPECT_EQ(allocations, before + 1);
}

TEST(Allocations, OfADragAreOverAfterItsFirstStep) {
  const ThreadLimit one_thread(1);  // the scheduler of threads allocates on its own
  PoseSession session(make_bar({1, 1, 4}, {8, 8, 32}),
                      scene_with("  handles:\n    - fix: z<10%\n    - {move: z>90%}\n"));
  FloatPoints positions, normals;
  HandlePath path;
  path.center = path.about = Vec3(0.5, 0.5, 4);
  path.axis = Vec3::UnitY();
  const auto step = [&](int number) {
    path.radians = 0.03 * number;
    path.by = 0.04 * number * Vec3::UnitX();
    session.lead(1, path);
    const Lbfgs::Result result = session.drag({.tolerance = 1e-6});
    session.deform(positions, normals);
    return result.iterations;
  };
  // As many iterations as the minimiser remembers, so that all its memory is there.
  ASSERT_GT(step(1), 8);
  const long before = allocations;
  for (int number = 2; number < 6; ++number) EXPECT_GT(step(number), 2);
  EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace supple
