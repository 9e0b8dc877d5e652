#pragma once
// Reports on work in progress: how far a run is, how its minimum changes, how fast it is, and how long it will take.

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/view/view.h"

namespace dmoscope::ui {

/// Change of a run's minimum over its records.
struct Trend {
  double minimum = 0.0;      // the latest minimum
  double gain = 0.0;         // rise over the last `over` iterations; negative when it fell
  std::uint64_t over = 0;    // number of iterations, at most ten
  std::uint64_t steady = 0;  // number of latest iterations in which it has changed by less than ConvergenceLimits::rise, all together
};
/// Trend of the records up to an iteration's end; none if that has no record.
[[nodiscard]] std::optional<Trend> trend_of(const SharedVector<IterationRecord>& records, std::uint64_t iteration);
/// Text of a trend: "minimum 0.4283, +0.01210 in the last 10", "minimum 0.4283, steady for 37 iterations".
[[nodiscard]] std::string trend_text(const Trend& trend);

/// Text of a run's speed: "8.21 M visits/s", the vertices searched per second by the last iteration that took time. Vertices that were
/// passed over, because nothing of their star had moved, are no visits; if visits are not counted (on a device), "1.61 G vertices/s". Empty
/// if there is no such iteration.
[[nodiscard]] std::string speed_text(const RunView& run);

/// Texts of a run's progress: "iteration 13 of 100", "minimum 0.4283, +0.01210 in the last 10", "12 s left", "8.21 M visits/s"; as many as
/// are known, the most important first. `seconds_left`: see Pace.
[[nodiscard]] std::vector<std::string> progress_parts(const RunView& run, std::optional<double> seconds_left);
/// The run whose iterations are under way; null when none is.
[[nodiscard]] const RunView* run_at_work(const SessionView& session);

/// Text of a remaining time: "12 s left", "5 min left".
[[nodiscard]] std::string time_left_text(double seconds);

/// Amount of work, done and in all: a run's iterations if their number is known in advance, else the figures of the progress. None if there
/// are neither.
struct WorkDone {
  std::string whose;  // line of the command that works
  double done = 0.0, all = 1.0;
  friend bool operator==(const WorkDone&, const WorkDone&) = default;
};
[[nodiscard]] std::optional<WorkDone> work_done(const RunView* run, std::string_view command, double progress);

/// Estimates from the work of the last seconds how long the rest will take.
class Pace {
 public:
  /// Notes the state of the work, once a frame. `now`: seconds on a steady clock.
  void note(double now, const std::optional<WorkDone>& work);
  /// Estimated seconds until the end; none while too little has been seen.
  [[nodiscard]] std::optional<double> seconds_left() const;

 private:
  std::optional<WorkDone> work_;
  std::deque<std::pair<double, double>> seen_;  // times, and the work done by then
};

}  // namespace dmoscope::ui
