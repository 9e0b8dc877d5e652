#pragma once
// What of a session is in no file, and what a person is asked before it is given up.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/view/view.h"

namespace dmoscope::ui {

/// The runs, by their places in the list, of which something would be lost; see SavedMarks.
[[nodiscard]] std::vector<std::size_t> unsaved_runs(const SessionView& session);

/// "east.14 – dmoscope", with a dot before it while something is in no file.
[[nodiscard]] std::string window_title(const SessionView& session);

/// Whether a command line ends the window, or puts another mesh in the place of the one that is open.
[[nodiscard]] bool gives_up_session(std::string_view line);

/// A command of a person that waits for an answer.
struct Leaving {
  enum class Phase { Asking, Saving, Going };
  std::string line;
  Phase phase = Phase::Asking;
};

/// What the question says: "Quit?", and what is in no file, a sentence a line.
struct UnsavedQuestion {
  std::string title;               // "Quit without saving?"
  std::vector<std::string> lines;  // "dmo · mean-ratio: iteration 12"
  std::string running;             // "a run is going on …"; empty where nothing is
};
[[nodiscard]] UnsavedQuestion unsaved_question(const SessionView& session, const Leaving& leaving, bool busy, const std::string& command);

}  // namespace dmoscope::ui
