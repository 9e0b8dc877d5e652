#pragma once
// The priorities of threads (Linux): 0 is usual, and the greater the number, the more others go first.

#include <barrier>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/resource.h>

#include "core/base/thread_pool.h"

namespace dmoscope::testing {

/// Of the calling thread.
inline int own_nice_value() { return ::getpriority(PRIO_PROCESS, 0); }

/// Of all threads of this program.
inline std::vector<int> nice_values() {
  std::vector<int> values;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task"))
    values.push_back(::getpriority(PRIO_PROCESS, static_cast<id_t>(std::stoul(task.path().filename().string()))));
  return values;
}

/// Of each thread of a pool, the caller's among them.
inline std::vector<int> nice_values_of(ThreadPool& pool) {
  std::vector<int> values(pool.size());
  std::barrier all_there(static_cast<std::ptrdiff_t>(pool.size()));  // so that each thread gets one of the pieces
  pool.parallel_for(pool.size(), 1, [&](std::size_t piece, std::size_t) {
    all_there.arrive_and_wait();
    values[piece] = own_nice_value();
  });
  return values;
}

}  // namespace dmoscope::testing
