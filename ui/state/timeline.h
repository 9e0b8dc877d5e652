#pragma once
// Moments on the timeline: marks, playing, and pictures of a run one after another.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

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

struct SequenceOptions {
  std::filesystem::path folder;
  std::uint64_t from = 0;
  std::optional<std::uint64_t> to;  // none: the last iteration of the history
  std::uint64_t every = 1;
  int width = 0, height = 0;  // pixels; 0: as on screen
  bool window = false;        // the whole interface instead of the mesh
  bool overwrite = false;
};

/// A sequence that is being taken.
struct Sequence {
  enum class Phase { Seek, Wait, Clean, Shot };  // Clean: the next frame shows no progress
  SequenceOptions options;
  std::vector<std::uint64_t> iterations;
  std::size_t done = 0;
  Phase phase = Phase::Seek;
  Moment before;  // moment of the run before the sequence, to return to

  [[nodiscard]] double progress() const noexcept { return static_cast<double>(done) / static_cast<double>(iterations.size()); }
  /// Path of the next picture, "frame-0012.png" in the folder.
  [[nodiscard]] std::filesystem::path next_file() const;
};

/// Plans a sequence and makes its folder. Throws UsageError (no mesh, no such iterations, frames exist already) and OutputError.
[[nodiscard]] Sequence plan_sequence(const SequenceOptions& options, const SessionView& session);

/// A command line (ffmpeg) that makes a video of the pictures.
[[nodiscard]] std::string video_line(const std::filesystem::path& folder, double frames_per_second);

}  // namespace dmoscope::ui
