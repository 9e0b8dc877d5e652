#include "ui/state/timeline.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/words.h"
#include "ui/state/run_names.h"

namespace dmoscope::ui {
namespace {

namespace fs = std::filesystem;

bool is_frame(const fs::path& path) {
  const std::string name = path.filename().string();
  constexpr std::string_view prefix = "frame-", suffix = ".png";
  if (!name.starts_with(prefix) || !name.ends_with(suffix) || name.size() <= prefix.size() + suffix.size()) return false;
  const std::string number = name.substr(prefix.size(), name.size() - prefix.size() - suffix.size());
  return number.find_first_not_of("0123456789") == std::string::npos;
}

/// Makes the folder; removes frames of an older sequence if that was asked for, else refuses because of them.
void prepare_folder(const SequenceOptions& options) {
  std::error_code error;
  fs::create_directories(options.folder, error);
  if (!fs::is_directory(options.folder, error))
    throw OutputError(options.folder.string(), "this folder cannot be made: " + error.message());
  for (fs::directory_iterator at(options.folder, error); !error && at != fs::directory_iterator(); at.increment(error)) {
    if (!is_frame(at->path())) continue;
    if (!options.overwrite)
      throw UsageError(fmt::format("{}: there are frames already; --overwrite replaces them", options.folder.string()));
    std::error_code ignored;
    fs::remove(at->path(), ignored);
  }
  if (error) throw OutputError(options.folder.string(), error.message());
}

}  // namespace

const Mark* Timeline::shown_mark() const noexcept {
  if (shown == Shown::A && a.frame) return &a;
  if (shown == Shown::B && b.frame) return &b;
  return nullptr;
}

void Timeline::flip() {
  const Shown other = shown == Shown::A ? Shown::B : Shown::A;
  const auto is_set = [this](Shown which) { return (which == Shown::A ? a : b).frame != nullptr; };
  if (is_set(other)) {
    shown = other;
  } else if (shown == Shown::Now && is_set(Shown::B)) {
    shown = Shown::B;
  } else {
    shown = Shown::Now;
  }
}

Mark mark_of(const SessionView& session) {
  if (!session.frame || session.active >= session.runs.size()) throw UsageError("no mesh is open");
  if (session.frame->device) throw UsageError("pause first: while the run goes on, this state is only on the device");
  return {session.frame, run_title(session, session.active)};
}

void drop_stale_marks(Timeline& timeline, const SessionView& session) {
  for (Mark* mark : {&timeline.a, &timeline.b}) {
    if (mark->frame && std::ranges::find(session.meshes, mark->frame->input_serial, &InputView::serial) == session.meshes.end()) *mark = {};
  }
  if (timeline.shown_mark() == nullptr) timeline.shown = Shown::Now;
}

std::optional<std::string> next_command(Playback& play, const SessionView& session, double now) {
  if (play.kind == Playback::Kind::Off || session.active >= session.runs.size()) {
    play.kind = Playback::Kind::Off;
    return std::nullopt;
  }
  if (now < play.due) return std::nullopt;
  const double interval = 1.0 / play.speed;
  play.due = std::max(play.due + interval, now);  // moments that could not be shown in time are skipped
  if (play.kind == Playback::Kind::Vertex) return "step vertex";
  if (play.kind == Playback::Kind::Class) return "step class";
  if (play.kind == Playback::Kind::Iteration) return "step iteration";
  const RunView& run = session.runs[session.active];
  const std::uint64_t last = run.records.empty() ? 0 : run.records.back().iteration;
  const bool restart = std::exchange(play.from_start, false) && run.moment.iteration >= last;
  if (last > 0 && restart) return "seek 0";
  if (run.moment.iteration < last) return fmt::format("seek {}", run.moment.iteration + 1);
  play.kind = Playback::Kind::Off;
  return std::nullopt;
}

fs::path Sequence::next_file() const { return options.folder / fmt::format("frame-{:04}.png", done); }

Sequence plan_sequence(const SequenceOptions& options, const SessionView& session) {
  if (session.active >= session.runs.size()) throw UsageError("no mesh is open");
  const RunView& run = session.runs[session.active];
  const std::uint64_t last = run.records.empty() ? 0 : run.records.back().iteration;
  const std::uint64_t to = options.to.value_or(last);
  if (options.from > to) throw UsageError(fmt::format("from iteration {} to {}: there is none in between", options.from, to));
  if (to > last) throw UsageError(fmt::format("the history ends at iteration {}: {} has not been run yet", last, to));
  Sequence sequence{options, {}, 0, Sequence::Phase::Seek, run.moment};
  for (std::uint64_t iteration = options.from; iteration < to; iteration += options.every) sequence.iterations.push_back(iteration);
  sequence.iterations.push_back(to);  // the last iteration is always shown
  prepare_folder(options);
  return sequence;
}

std::string video_line(const fs::path& folder, double frames_per_second) {
  std::string name = folder.lexically_normal().string();
  while (name.size() > 1 && name.ends_with('/')) name.pop_back();
  // Most players want even numbers of pixels.
  return fmt::format("ffmpeg -framerate {:g} -i {} -vf \"pad=ceil(iw/2)*2:ceil(ih/2)*2\" -c:v libx264 -pix_fmt yuv420p {}",
                     frames_per_second, quote_word(name + "/frame-%04d.png"), quote_word(name + ".mp4"));
}

}  // namespace dmoscope::ui
