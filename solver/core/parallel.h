#pragma once

#include <functional>

#include "solver/core/export.h"
#include "solver/core/types.h"

namespace supple {

/// Calls body(begin, end) on chunks of [0, count) by several threads. The chunks depend on
/// `chunk` alone, never on the number of threads, so that results which are put together in
/// chunk order are the same for every number of threads.
SUPPLE_API void parallel_chunks(Index count, Index chunk,
                                const std::function<void(Index begin, Index end)>& body);

/// Holds the number of threads at `threads` (0: all) as long as it lives.
class SUPPLE_API ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  void* control_ = nullptr;
};

}  // namespace supple
