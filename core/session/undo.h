#pragma once
// Undo and redo. What a command changed is remembered as where the session stood before and after it; paths are followed again bit for
// bit, so nothing else is needed.

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/run/run.h"

namespace dmoscope {

/// Where a session stands. Keeps its runs and their meshes alive.
struct SessionPoint {
  struct Standing {
    std::shared_ptr<Run> run;
    RunSnapshot point;
    std::string name;
  };
  std::shared_ptr<const InputMesh> input;  // of the active run; null: no mesh is open
  std::vector<Standing> runs;
  std::size_t active = 0;
  Metric shown = Metric::MeanRatio;

  /// Whether runs, their names and their moments are the same; which run is active and what is shown does not count.
  [[nodiscard]] bool same_state(const SessionPoint& other) const;
};

/// One command that changed something.
struct UndoEntry {
  std::string label;  // "run 10"
  SessionPoint before, after;
};

class UndoStack {
 public:
  static constexpr std::size_t kMostEntries = 100;
  /// Meshes and runs that only undo still refers to.
  static constexpr std::size_t kMostInputs = 3, kMostRuns = 12;

  /// Remembers what a command did, unless it changed nothing or there was no mesh before; what was undone cannot be redone any more.
  /// Seeks in a row ("seek 3", "seek 4", ...) are one entry. The oldest entries are forgotten when there are too many.
  void record(std::string label, const SessionPoint& before, const SessionPoint& after);

  /// What would be undone or redone; null: nothing.
  [[nodiscard]] const UndoEntry* to_undo() const noexcept { return done_ > 0 ? &entries_[done_ - 1] : nullptr; }
  [[nodiscard]] const UndoEntry* to_redo() const noexcept { return done_ < entries_.size() ? &entries_[done_] : nullptr; }
  /// It has been.
  void undone() noexcept { --done_; }
  void redone() noexcept { ++done_; }

  /// The runs that only undo knows, when the session has those of `now`.
  [[nodiscard]] std::vector<std::shared_ptr<Run>> retired_runs(const SessionPoint& now) const;

 private:
  void bound(const SessionPoint& now);
  [[nodiscard]] std::size_t retired_inputs(const SessionPoint& now) const;

  std::vector<UndoEntry> entries_;  // oldest first
  std::size_t done_ = 0;            // of these; the others have been undone
};

}  // namespace dmoscope
