#pragma once
// Undo and redo. The effect of a command is recorded as the session's points before and after it; paths are followed again bit for bit, so
// nothing else is needed.

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/run/run.h"

namespace dmoscope {

/// Point at which a session stands. Keeps its runs and their meshes alive.
struct SessionPoint {
  struct Standing {
    std::shared_ptr<Run> run;
    RunSnapshot point;
    std::string name;
  };
  std::shared_ptr<const InputMesh> input;  // mesh of the active run; null: no mesh is open
  std::vector<Standing> runs;
  std::size_t active = 0;
  Metric shown = Metric::MeanRatio;

  /// Whether runs, their names and their moments are the same; which run is active and what is shown does not count.
  [[nodiscard]] bool same_state(const SessionPoint& other) const;
};

/// One command with an effect.
struct UndoEntry {
  std::string label;  // such as "run 10"
  SessionPoint before, after;
};

class UndoStack {
 public:
  static constexpr std::size_t kMostEntries = 100;
  /// Limits for meshes and runs that only undo still refers to.
  static constexpr std::size_t kMostInputs = 3, kMostRuns = 12;

  /// Records the effect of a command, unless it has none or there was no mesh before; undone commands can then not be redone any more.
  /// Seeks in a row ("seek 3", "seek 4", ...) are one entry. The oldest entries are removed if there are too many.
  void record(std::string label, const SessionPoint& before, const SessionPoint& after);

  /// The entry that would be undone; the other function has that to be redone. Null: none.
  [[nodiscard]] const UndoEntry* to_undo() const noexcept { return done_ > 0 ? &entries_[done_ - 1] : nullptr; }
  [[nodiscard]] const UndoEntry* to_redo() const noexcept { return done_ < entries_.size() ? &entries_[done_] : nullptr; }
  /// Marks the last entry as undone.
  void undone() noexcept { --done_; }
  void redone() noexcept { ++done_; }

  /// The runs that only undo knows, if the session has those of `now`.
  [[nodiscard]] std::vector<std::shared_ptr<Run>> retired_runs(const SessionPoint& now) const;

 private:
  void bound(const SessionPoint& now);
  [[nodiscard]] std::size_t retired_inputs(const SessionPoint& now) const;

  std::vector<UndoEntry> entries_;  // entries, oldest first
  std::size_t done_ = 0;            // number of entries that are done; the others have been undone
};

}  // namespace dmoscope
