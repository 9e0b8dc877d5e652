#pragma once
// Pictures of one iteration after another, for a video: the session seeks, the window takes a screenshot, and so on.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/view/view.h"

namespace dmoscope::ui {

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
