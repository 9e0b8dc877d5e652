#pragma once
// What is said of work while it goes on: how far a run is, where its minimum goes, how fast it is, and how long it will take.

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/view/view.h"

namespace dmoscope::ui {

/// Where the minimum of a run's records goes.
struct Trend {
  double minimum = 0.0;      // now
  double gain = 0.0;         // over the last `over` iterations, by what it rose; negative where it fell
  std::uint64_t over = 0;    // at most ten
  std::uint64_t steady = 0;  // iterations in which it has changed by less than ConvergenceLimits::rise, all together
};
/// Of the records up to an iteration's end; none where that has no record.
[[nodiscard]] std::optional<Trend> trend_of(const SharedVector<IterationRecord>& records, std::uint64_t iteration);
/// "minimum 0.4283, +0.01210 in the last 10", "minimum 0.4283, steady for 37 iterations"
[[nodiscard]] std::string trend_text(const Trend& trend);

/// "8.21 M visits/s": how many vertices the last iteration that took time searched in a second. Vertices that were passed over, for nothing
/// of their star had moved, are no visits; where nobody counts those (on a device), "1.61 G vertices/s". Empty where there is no such
/// iteration.
[[nodiscard]] std::string speed_text(const RunView& run);

/// "iteration 13 of 100", "minimum 0.4283, +0.01210 in the last 10", "12 s left", "8.21 M visits/s": as much of it as is known, what
/// matters most first. `seconds_left`: see Pace.
[[nodiscard]] std::vector<std::string> progress_parts(const RunView& run, std::optional<double> seconds_left);
/// The run whose iterations are under way; null when none is.
[[nodiscard]] const RunView* run_at_work(const SessionView& session);

/// "12 s left", "5 min left"
[[nodiscard]] std::string time_left_text(double seconds);

/// How much of the work there is and how much is done: of a run's iterations where it is known how many there will be, else of what the
/// progress tells. None where neither is.
struct WorkDone {
  std::string whose;  // the command's line
  double done = 0.0, all = 1.0;
  friend bool operator==(const WorkDone&, const WorkDone&) = default;
};
[[nodiscard]] std::optional<WorkDone> work_done(const RunView* run, std::string_view command, double progress);

/// From what was done in the last seconds, how long the rest will take.
class Pace {
 public:
  /// Once a frame. `now`: seconds on a steady clock.
  void note(double now, const std::optional<WorkDone>& work);
  /// None while too little has been seen.
  [[nodiscard]] std::optional<double> seconds_left() const;

 private:
  std::optional<WorkDone> work_;
  std::deque<std::pair<double, double>> seen_;  // when, and what was done then
};

}  // namespace dmoscope::ui
