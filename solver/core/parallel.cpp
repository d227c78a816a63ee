#include "solver/core/parallel.h"

#include <algorithm>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_group.h>

#include "solver/core/arithmetic.h"

namespace supple {

void parallel_chunks(Index count, Index chunk, const std::function<void(Index, Index)>& body) {
  const Index chunks = (count + chunk - 1) / chunk;
  if (chunks <= 1) {
    if (count > 0) body(0, count);
    return;
  }
  // With the caller's rounding, whatever the threads had.
  tbb::task_group_context context(
      tbb::task_group_context::bound,
      tbb::task_group_context::default_traits | tbb::task_group_context::fp_settings);
  tbb::parallel_for(
      Index{0}, chunks, [&](Index c) { body(c * chunk, std::min(count, (c + 1) * chunk)); },
      tbb::simple_partitioner(), context);
}

ThreadLimit::ThreadLimit(int threads) {
  if (threads > 0)
    control_ = new tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                       static_cast<std::size_t>(threads));
}

ThreadLimit::~ThreadLimit() {
  delete static_cast<tbb::global_control*>(control_);
}

}  // namespace supple
