#pragma once
// Finds unsaved parts of a session, and the question to ask before it is given up.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/view/view.h"

namespace dmoscope::ui {

/// Indices of the runs of which something would be lost; see SavedMarks.
[[nodiscard]] std::vector<std::size_t> unsaved_runs(const SessionView& session);

/// Title of the window: "east.14 – dmoscope", with a dot before it while something is not saved.
[[nodiscard]] std::string window_title(const SessionView& session);

/// Whether a command line closes the window, or replaces the open mesh by another one.
[[nodiscard]] bool gives_up_session(std::string_view line);

/// A command of a person that waits for an answer.
struct Leaving {
  enum class Phase { Asking, Saving, Going };
  std::string line;
  Phase phase = Phase::Asking;
};

/// The question before unsaved work is given up: a title, and one line for each thing that is not saved.
struct UnsavedQuestion {
  std::string title;               // "Quit without saving?"
  std::vector<std::string> lines;  // "dmo · mean-ratio: iteration 12"
  std::string running;             // "a run is going on …"; empty when there is none
};
[[nodiscard]] UnsavedQuestion unsaved_question(const SessionView& session, const Leaving& leaving, bool busy, const std::string& command);

}  // namespace dmoscope::ui
