#include "ui/state/timeline.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/error.h"
#include "ui/state/run_names.h"

namespace dmoscope::ui {

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

}  // namespace dmoscope::ui
