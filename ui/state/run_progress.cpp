#include "ui/state/run_progress.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

std::string iteration_text(const RunView& run) {
  const std::uint64_t under_way = run.moment.iteration + 1;
  if (!run.pursuit || run.pursuit->until_converged) return "iteration " + count(under_way);
  const auto& [from, last, until_converged, patience] = *run.pursuit;
  return fmt::format("iteration {} of {}", count(std::min(under_way, last) - from), count(last - from));
}

/// A rate with its noun: "8.21 M visits/s".
std::string per_second(std::string_view what, double value) {
  std::string text = rate(value);
  if (!text.ends_with(' ')) text += ' ';
  return text.append(what).append("/s");
}

}  // namespace

std::optional<Trend> trend_of(const SharedVector<IterationRecord>& records, std::uint64_t iteration) {
  constexpr std::uint64_t kRecent = 10;
  if (iteration >= records.size()) return std::nullopt;
  const auto minimum = [&](std::uint64_t k) { return records[k].statistics.minimum; };
  Trend trend{minimum(iteration), 0.0, std::min(iteration, kRecent), 0};
  if (!std::isfinite(trend.minimum)) return std::nullopt;
  trend.gain = trend.over == 0 ? 0.0 : trend.minimum - minimum(iteration - trend.over);
  while (trend.steady < iteration && std::abs(trend.minimum - minimum(iteration - trend.steady - 1)) < ConvergenceLimits{}.rise)
    ++trend.steady;
  return trend;
}

std::string trend_text(const Trend& trend) {
  std::string text = "minimum " + short_number(trend.minimum);
  if (trend.steady > 0) return text + ", steady for " + counted(trend.steady, "iteration", "iterations");
  if (trend.over == 0 || !std::isfinite(trend.gain)) return text;
  text += fmt::format(", {}{}", trend.gain < 0.0 ? "−" : "+", short_number(std::abs(trend.gain)));
  return text + (trend.over == 1 ? " in the last iteration" : fmt::format(" in the last {}", trend.over));
}

std::string speed_text(const RunView& run) {
  for (std::size_t k = run.records.size(); k-- > 1;) {
    const IterationRecord& record = run.records[k];
    if (!(record.seconds > 0.0)) continue;
    if (record.searched > 0) return per_second("visits", static_cast<double>(record.searched) / record.seconds);
    // On the CPU visits are counted: none means that all vertices were at rest, or that the record is of an older session.
    if (run.backend == Backend::Cpu) return {};
    return per_second("vertices", static_cast<double>(run.free_vertices) / record.seconds);
  }
  return {};
}

std::string time_left_text(double seconds) {
  constexpr double kMinute = 60.0, kHour = 3600.0;
  if (!std::isfinite(seconds)) return {};
  if (seconds >= 2.0 * kHour) return fmt::format("{:.0f} h left", seconds / kHour);
  if (seconds >= 2.0 * kMinute) return fmt::format("{:.0f} min left", seconds / kMinute);
  return fmt::format("{:.0f} s left", std::ceil(seconds));
}

std::vector<std::string> progress_parts(const RunView& run, std::optional<double> seconds_left) {
  std::vector<std::string> parts{iteration_text(run)};
  const std::uint64_t iteration = run.moment.iteration;
  if (iteration < run.records.size() && run.records[iteration].statistics.inverted > 0)
    parts.push_back(count(run.records[iteration].statistics.inverted) + " inverted");
  if (const auto trend = trend_of(run.records, iteration)) parts.push_back(trend_text(*trend));
  if (run.pursuit && run.pursuit->patience_left) {
    parts.push_back(fmt::format("ends after {} more without gain", count(*run.pursuit->patience_left)));
  } else if (seconds_left) {
    parts.push_back(time_left_text(*seconds_left));
  }
  if (std::string speed = speed_text(run); !speed.empty()) parts.push_back(std::move(speed));
  return parts;
}

const RunView* run_at_work(const SessionView& session) {
  const auto at = std::ranges::find_if(session.runs, [](const RunView& run) { return run.pursuit.has_value(); });
  return at == session.runs.end() ? nullptr : &*at;
}

std::optional<WorkDone> work_done(const RunView* run, std::string_view command, double progress) {
  if (run == nullptr || !run->pursuit) return WorkDone{std::string(command), progress, 1.0};
  const Pursuit& pursuit = *run->pursuit;
  if (pursuit.until_converged) return std::nullopt;  // not known in advance
  const auto whole = static_cast<double>(std::max<std::uint64_t>(1, run->visits_per_iteration));
  const double done = static_cast<double>(run->moment.iteration - pursuit.from) + static_cast<double>(run->moment.visits) / whole;
  return WorkDone{std::string(command), done, static_cast<double>(pursuit.last - pursuit.from)};
}

void Pace::note(double now, const std::optional<WorkDone>& work) {
  constexpr double kRemembered = 4.0;  // seconds that are remembered: work gets faster and slower
  const bool same = work && work_ && work->whose == work_->whose && work->all == work_->all && work->done >= work_->done;
  if (!same) seen_.clear();
  const bool moved = !same || work->done > work_->done;
  work_ = work;
  if (!work || !moved) return;
  seen_.emplace_back(now, work->done);
  while (seen_.size() > 2 && now - seen_[1].first > kRemembered) seen_.pop_front();
}

std::optional<double> Pace::seconds_left() const {
  constexpr double kLeast = 0.5;  // seconds that must have been seen before an estimate
  if (!work_ || seen_.size() < 2) return std::nullopt;
  const double seconds = seen_.back().first - seen_.front().first, done = seen_.back().second - seen_.front().second;
  if (seconds < kLeast || !(done > 0.0)) return std::nullopt;
  return std::max(0.0, (work_->all - work_->done) * seconds / done);
}

}  // namespace dmoscope::ui
