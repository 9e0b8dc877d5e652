#pragma once
// Context of reading and writing, given by the caller.

#include <cstdint>

#include "core/base/progress.h"
#include "core/base/thread_pool.h"
#include "core/mesh/geographic.h"
#include "core/mesh/thin.h"

namespace dmoscope {

/// Progress, threads and settings for reading and writing. The result does not depend on the number of threads.
struct IoContext {
  IoContext(Progress& watched, ThreadPool* threads = nullptr, std::uint64_t memory = 0)  // NOLINT(google-explicit-constructor)
      : progress(watched), pool(threads), most_memory(memory) {}
  Progress& progress;
  ThreadPool* pool;                         // null: the calling thread alone
  std::uint64_t most_memory;                // bytes that a file may unpack to; 0: see UnpackBudget
  Geographic geographic = Geographic::Off;  // whether load_input() takes coordinates for degrees
  Thin thin = Thin::Off;                    // whether load_input() replaces a mesh one cell thick by its front
  std::size_t pieces = 0;                   // number of pieces in formats with several files; 0: the format's default
};

}  // namespace dmoscope
