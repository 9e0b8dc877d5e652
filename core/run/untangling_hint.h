#pragma once
// Where a method leaves elements inverted: does another get further?

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/run/run.h"

namespace dmoscope {

struct UntanglingHint {
  std::string method;            // that gets further
  Index left = 0;                // elements that it leaves inverted
  std::uint64_t iterations = 0;  // after so many
  /// "angle-based leaves 0 of them after 12 iterations"
  [[nodiscard]] std::string sentence() const;
};

struct UntanglingLook {
  std::optional<UntanglingHint> hint{};  // none where none of those that cost little leaves fewer
  bool to_the_end = true;
};

/// Tries each method that can be from the input on, with the run's other parameters; some 2 million visits each at most. A cancel, and
/// `go_on`, which is asked every now and then, end the look, but not what it has found by then.
[[nodiscard]] UntanglingLook untangling_hint(const Run& run, std::shared_ptr<ThreadPool> pool, Progress& progress,
                                             const std::function<bool()>& go_on = {});

}  // namespace dmoscope
