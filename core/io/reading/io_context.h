#pragma once
// What reading and writing need of their caller.

#include <cstdint>

#include "core/base/progress.h"
#include "core/base/thread_pool.h"
#include "core/mesh/geographic.h"
#include "core/mesh/thin.h"

namespace dmoscope {

/// Who watches the work, and the threads that share it. The result is the same for any number of them.
struct IoContext {
  IoContext(Progress& watched, ThreadPool* threads = nullptr, std::uint64_t memory = 0)  // NOLINT(google-explicit-constructor)
      : progress(watched), pool(threads), most_memory(memory) {}
  Progress& progress;
  ThreadPool* pool;                         // null: the calling thread alone
  std::uint64_t most_memory;                // bytes that a file may unpack to; 0: see UnpackBudget
  Geographic geographic = Geographic::Off;  // whether coordinates are taken for degrees, by load_input()
  Thin thin = Thin::Off;                    // whether a mesh one cell thick is taken for that of its front, by load_input()
  std::size_t pieces = 0;                   // into which a format that has several files cuts a mesh; 0: as it likes
};

}  // namespace dmoscope
