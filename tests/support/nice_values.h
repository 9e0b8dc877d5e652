#pragma once
// Priorities of threads (Linux): 0 is usual, and a thread with a greater number gives way to others.

#include <barrier>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/resource.h>

#include "core/base/thread_pool.h"

namespace dmoscope::testing {

/// Priority of the calling thread.
inline int own_nice_value() { return ::getpriority(PRIO_PROCESS, 0); }

/// Priorities of all threads of this program.
inline std::vector<int> nice_values() {
  std::vector<int> values;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task"))
    values.push_back(::getpriority(PRIO_PROCESS, static_cast<id_t>(std::stoul(task.path().filename().string()))));
  return values;
}

/// Priorities of all threads of a pool, including the caller's.
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
