#pragma once
// How long may be looked, after a run, for what nobody has asked for.

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

#include "core/base/stopwatch.h"

namespace dmoscope {

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
  /// Half of what is left of it.
  [[nodiscard]] HintBudget half() const { return clock_ ? HintBudget(0.5 * (end_ - clock_()), clock_) : HintBudget(); }

 private:
  [[nodiscard]] static Clock since_now() {
    return [watch = Stopwatch()] { return watch.seconds(); };
  }

  Clock clock_{};
  double end_ = std::numeric_limits<double>::infinity();
};

}  // namespace dmoscope
