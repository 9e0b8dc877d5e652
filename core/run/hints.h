#pragma once
// Looks after a run that nobody has asked for: whether another method gets further where elements stay inverted, what holds the minimum,
// and how long these looks may take.

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

/// Time that a look may take.
class HintBudget {
 public:
  using Clock = std::function<double()>;  // seconds that have passed

  /// Sets no limit.
  HintBudget() = default;
  /// Lets `seconds` pass from now on.
  explicit HintBudget(double seconds, Clock clock = since_now()) : clock_(std::move(clock)), end_(clock_() + seconds) {}
  /// Gives a tenth of the run's time, and at least 0.2 s.
  [[nodiscard]] static HintBudget of_run(double seconds, Clock clock = since_now()) {
    return HintBudget(std::max(0.2, 0.1 * seconds), std::move(clock));
  }

  [[nodiscard]] bool left() const { return !clock_ || clock_() < end_; }
  [[nodiscard]] bool has(double seconds) const { return !clock_ || clock_() + seconds <= end_; }
  /// Gives half of the time that is left.
  [[nodiscard]] HintBudget half() const { return clock_ ? HintBudget(0.5 * (end_ - clock_()), clock_) : HintBudget(); }

 private:
  [[nodiscard]] static Clock since_now() {
    return [watch = Stopwatch()] { return watch.seconds(); };
  }

  Clock clock_{};
  double end_ = std::numeric_limits<double>::infinity();
};

struct UntanglingHint {
  std::string method;            // the method that gets further
  Index left = 0;                // elements that it leaves inverted
  std::uint64_t iterations = 0;  // number of iterations that it took
  /// Sentence for a person: "angle-based leaves 0 of them after 12 iterations".
  [[nodiscard]] std::string sentence() const;
};

struct UntanglingLook {
  std::optional<UntanglingHint> hint{};  // none where no method of those that cost little leaves fewer inverted elements
  bool to_the_end = true;
};

/// Tries each method that can be from the input on, with the run's other parameters; some 2 million visits each at most. A cancel, or a no
/// of `go_on`, which is asked every now and then, ends the look; it returns what it has found by then.
[[nodiscard]] UntanglingLook untangling_hint(const Run& run, std::shared_ptr<ThreadPool> pool, Progress& progress,
                                             const std::function<bool()>& go_on = {});

struct HoldLook {
  DomainSource domains{};
  std::function<bool()> go_on{};  // see held_minimum(); empty: to the end
  bool at_rest = false;           // nobody has asked: the look must not take long, and holders are drawn
};

/// Finds the holders of the minimum of the metric that the run optimises, see held_minimum(). Brings the positions to the host. Throws
/// DeviceError.
[[nodiscard]] std::optional<HeldMinimum> what_holds(const Run& run, ThreadPool* pool, Progress& progress, const HoldLook& look = {});

}  // namespace dmoscope
