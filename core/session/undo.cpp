#include "core/session/undo.h"

#include <algorithm>
#include <utility>

namespace dmoscope {

namespace {

/// Whether a label is a plain "seek 12": a place on the timeline, one of many that dragging passes.
bool plain_seek(std::string_view label) {
  constexpr std::string_view kSeek = "seek ";
  return label.starts_with(kSeek) && label.find(' ', kSeek.size()) == std::string_view::npos;
}

/// Calls `take` with every point of the entries.
template <class Take>
void for_points(const std::vector<UndoEntry>& entries, const Take& take) {
  for (const UndoEntry& entry : entries) {
    take(entry.before);
    take(entry.after);
  }
}

template <class T>
void add_new(std::vector<T>& list, const T& value) {
  if (std::ranges::find(list, value) == list.end()) list.push_back(value);
}

}  // namespace

bool SessionPoint::same_state(const SessionPoint& other) const {
  const auto same = [](const Standing& a, const Standing& b) {
    return a.run == b.run && a.point.moment == b.point.moment && a.point.path == b.point.path && a.name == b.name;
  };
  return std::equal(runs.begin(), runs.end(), other.runs.begin(), other.runs.end(), same);
}

void UndoStack::record(std::string label, const SessionPoint& before, const SessionPoint& after) {
  if (!before.input || before.same_state(after)) return;
  const bool nothing_undone = done_ == entries_.size();
  entries_.resize(done_);
  if (nothing_undone && done_ > 0 && plain_seek(label) && plain_seek(entries_.back().label) && entries_.back().after.same_state(before)) {
    entries_.back().label = std::move(label);
    entries_.back().after = after;
    return;
  }
  entries_.push_back({std::move(label), before, after});
  ++done_;
  bound(after);
}

/// Removes the oldest entries while there is too much to keep.
void UndoStack::bound(const SessionPoint& now) {
  const auto too_much = [&] {
    return entries_.size() > kMostEntries || retired_inputs(now) > kMostInputs || retired_runs(now).size() > kMostRuns;
  };
  while (entries_.size() > 1 && too_much()) {
    entries_.erase(entries_.begin());
    --done_;
  }
}

std::size_t UndoStack::retired_inputs(const SessionPoint& now) const {
  std::vector<std::shared_ptr<const InputMesh>> open, retired;
  for (const SessionPoint::Standing& standing : now.runs) add_new(open, standing.run->shared_input());
  for_points(entries_, [&](const SessionPoint& point) {
    for (const SessionPoint::Standing& standing : point.runs)
      if (std::ranges::find(open, standing.run->shared_input()) == open.end()) add_new(retired, standing.run->shared_input());
  });
  return retired.size();
}

std::vector<std::shared_ptr<Run>> UndoStack::retired_runs(const SessionPoint& now) const {
  std::vector<std::shared_ptr<Run>> runs;
  for_points(entries_, [&](const SessionPoint& point) {
    for (const SessionPoint::Standing& standing : point.runs)
      if (std::ranges::find(now.runs, standing.run, &SessionPoint::Standing::run) == now.runs.end()) add_new(runs, standing.run);
  });
  return runs;
}

}  // namespace dmoscope
