#pragma once
// Two marked moments to flip between, and the history (or the stepping) played by itself. Plain state.

#include <memory>
#include <optional>
#include <string>

#include "core/view/view.h"

namespace dmoscope::ui {

/// State on show: the session's present one, or one of the marks.
enum class Shown { Now, A, B };

/// A marked moment, kept whole, so that it can be shown whatever the session does meanwhile.
struct Mark {
  std::shared_ptr<const Frame> frame;  // null: not set
  std::string title;                   // title of its run: "2 dmo · mean ratio"
};

struct Playback {
  enum class Kind { Off, History, Vertex, Class, Iteration };
  static constexpr double kSlowest = 0.5, kFastest = 60.0;
  Kind kind = Kind::Off;
  double speed = 10.0;  // iterations (or steps) per second
  double due = 0.0;     // time at which the next is to be shown, in seconds
  bool from_start = false;
};

struct Timeline {
  Mark a, b;
  Shown shown = Shown::Now;
  Playback play;

  [[nodiscard]] const Mark* shown_mark() const noexcept;
  /// Shows the next of the marks that are set: A, B, A, ...; with a single mark in turn the present state and the mark. Does nothing
  /// without a mark.
  void flip();
};

/// A mark of the session's present state. Throws UsageError when nothing is open, or when that state is only on a device just now.
[[nodiscard]] Mark mark_of(const SessionView& session);

/// Removes marks on another input than the session's.
void drop_stale_marks(Timeline& timeline, const SessionView& session);

/// The command that is due at `now` (seconds), if any; the session must be idle. Stops at the last iteration of the history. The next
/// command is due 1 / speed later.
[[nodiscard]] std::optional<std::string> next_command(Playback& play, const SessionView& session, double now);

}  // namespace dmoscope::ui
