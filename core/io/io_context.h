#pragma once
// What reading and writing need of their caller.

#include "core/base/progress.h"
#include "core/base/thread_pool.h"

namespace dmoscope {

/// Who watches the work, and the threads that share it. The result is the same for any number of them.
struct IoContext {
  IoContext(Progress& watched, ThreadPool* threads = nullptr) : progress(watched), pool(threads) {}  // NOLINT(google-explicit-constructor)
  Progress& progress;
  ThreadPool* pool;  // null: the calling thread alone
};

}  // namespace dmoscope
