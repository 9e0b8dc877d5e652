#pragma once
// Limit for the number of threads that the user may ask for.

#include <cstdint>

#include <fmt/format.h>

#include "core/base/error.h"

namespace dmoscope {

inline constexpr unsigned kMostThreads = 1024;

/// Throws UsageError for more threads than the limit; 0 stands for all processors.
inline void require_thread_count(std::uint64_t threads) {
  if (threads > kMostThreads)
    throw UsageError(fmt::format("threads: expected a whole number from 0 to {}, not '{}'", kMostThreads, threads));
}

}  // namespace dmoscope
