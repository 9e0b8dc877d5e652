#pragma once
// Context of reading and writing, given by the caller.

#include <algorithm>
#include <cstddef>
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

// Limit for the unpacked size of a file, so that one of a few kilobytes does not fill the memory.

/// Bytes that a file may unpack to. Each part is taken from the budget before its memory is allocated.
class UnpackBudget {
 public:
  /// Sets the budget. `most`: the limit that the user gave; 0: none. Then a file may unpack to a hundred times its size, and to 256 MiB in
  /// any case: real ones, even those of constant fields, need far less.
  UnpackBudget(std::size_t file_bytes, std::uint64_t most) noexcept : left_(UnpackBudget::most(file_bytes, most)) {}
  /// The bytes that a file of this size may unpack to.
  [[nodiscard]] static constexpr std::uint64_t most(std::size_t file_bytes, std::uint64_t most) noexcept {
    return most != 0 ? most : std::max(kAlways, kTimes * file_bytes);
  }
  /// Takes bytes from the budget. False: fewer are left.
  [[nodiscard]] bool take(std::uint64_t bytes) noexcept {
    if (bytes > left_) return false;
    left_ -= bytes;
    return true;
  }
  /// Second part of the error message "... unpacks to more than a file of this size should; ..."; the reader adds the first.
  [[nodiscard]] static constexpr const char* advice() noexcept {
    return "more than a file of this size should; --max-memory SIZE (in a script: max-memory SIZE) says how much is fine";
  }

 private:
  static constexpr std::uint64_t kAlways = std::uint64_t{256} << 20U;
  static constexpr std::uint64_t kTimes = 100;
  std::uint64_t left_;
};

}  // namespace dmoscope
