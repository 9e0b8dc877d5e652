#pragma once
// Two marked moments to flip between, and the history (or the stepping) played by itself. Plain state.

#include <memory>
#include <optional>
#include <string>

#include "core/view/view.h"

namespace dmoscope::ui {

/// What the view shows: the session as it stands, or one of the marks.
enum class Shown { Now, A, B };

/// A moment that was marked, whole, so that it can be shown whatever the session does meanwhile.
struct Mark {
  std::shared_ptr<const Frame> frame;  // null: not set
  std::string title;                   // of its run: "2 dmo · mean ratio"
};

struct Playback {
  enum class Kind { Off, History, Vertex, Class, Iteration };
  static constexpr double kSlowest = 0.5, kFastest = 60.0;
  Kind kind = Kind::Off;
  double speed = 10.0;  // iterations (or steps) a second
  double due = 0.0;     // when the next is to be shown, seconds
  bool from_start = false;
};

struct Timeline {
  Mark a, b;
  Shown shown = Shown::Now;
  Playback play;

  [[nodiscard]] const Mark* shown_mark() const noexcept;
  /// Moves on: A, B, A, ... of those that are set; now and the mark in turn when there is but one. Nothing when there is none.
  void flip();
};

/// Marks what the session shows. Throws UsageError when nothing is open, or when all there is of it is on a device just now.
[[nodiscard]] Mark mark_of(const SessionView& session);

/// Forgets marks on another input than the session's.
void drop_stale_marks(Timeline& timeline, const SessionView& session);

/// The command that is due at `now` (seconds), if any; the session is idle. Ends the playing of the history at its last iteration. The
/// next one is due 1 / speed later.
[[nodiscard]] std::optional<std::string> next_command(Playback& play, const SessionView& session, double now);

}  // namespace dmoscope::ui
