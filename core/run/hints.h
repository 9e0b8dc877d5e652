#pragma once
// What is looked for after a run though nobody has asked: whether another method gets further where elements stay inverted, what holds the
// minimum, and how long that may take.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/base/stopwatch.h"
#include "core/inspect/held_minimum.h"
#include "core/run/run.h"

namespace dmoscope {

/// How long may be looked.
class HintBudget {
 public:
  using Clock = std::function<double()>;  // seconds that have passed

  /// As long as it takes.
  HintBudget() = default;
  /// From now on.
  explicit HintBudget(double seconds, Clock clock = since_now()) : clock_(std::move(clock)), end_(clock_() + seconds) {}
  /// A tenth of what the run took, and at least 0.2 s.
  [[nodiscard]] static HintBudget of_run(double seconds, Clock clock = since_now()) {
    return HintBudget(std::max(0.2, 0.1 * seconds), std::move(clock));
  }

  [[nodiscard]] bool left() const { return !clock_ || clock_() < end_; }
  [[nodiscard]] bool has(double seconds) const { return !clock_ || clock_() + seconds <= end_; }
  /// Half of what is left of it.
  [[nodiscard]] HintBudget half() const { return clock_ ? HintBudget(0.5 * (end_ - clock_()), clock_) : HintBudget(); }

 private:
  [[nodiscard]] static Clock since_now() {
    return [watch = Stopwatch()] { return watch.seconds(); };
  }

  Clock clock_{};
  double end_ = std::numeric_limits<double>::infinity();
};

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

struct HoldLook {
  DomainSource domains{};
  std::function<bool()> go_on{};  // see held_minimum(); empty: to the end
  bool at_rest = false;           // nobody has asked: it is not to take long, and holders are drawn
};

/// What holds the minimum of the metric that the run optimises, see held_minimum(). Brings the positions. Throws DeviceError.
[[nodiscard]] std::optional<HeldMinimum> what_holds(const Run& run, ThreadPool* pool, Progress& progress, const HoldLook& look = {});

}  // namespace dmoscope
