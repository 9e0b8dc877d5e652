// Keys that are commands; and work that the window does by itself, frame by frame: playing, sequences of pictures, watching a file,
// showing a mark.
#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <imgui.h>

#include "ui/app.h"
#include "ui/commands/unsaved_commands.h"
#include "ui/commands/view_json.h"
#include "ui/state/actions.h"

namespace dmoscope::ui {
namespace {

/// Whether holding the key repeats the action. Switching something, or opening something, is done once.
bool goes_on_while_held(const Action& action) {
  constexpr std::array kSmallSteps{"step ", "back ",  "timeline ", "zoom ", "speed ",    "brush-radius ", "arrow-scale ",
                                   "peel ", "scale ", "undo",      "redo",  "each step", "each back"};
  return std::ranges::any_of(kSmallSteps, [&](std::string_view begin) { return action.command.starts_with(begin); });
}

bool is_step(std::string_view command) { return command.starts_with("step ") || command.starts_with("back "); }

}  // namespace

/// The session's present state, or with a mark's frame in place of its own.
std::shared_ptr<const SessionView> App::shown_view() {
  std::shared_ptr<const SessionView> now = engine_.view();
  drop_stale_marks(state_.timeline, *now);
  const Mark* mark = state_.timeline.shown_mark();
  if (mark == nullptr) {
    flipped_ = {};
    return now;
  }
  if (flipped_.now != now || flipped_.mark != mark->frame) {
    auto view = std::make_shared<SessionView>(*now);
    view->frame = mark->frame;
    flipped_ = {now, mark->frame, std::move(view)};
  }
  return flipped_.view;
}

void App::set_wake(const std::function<void()>& wake) {
  wake_ = wake;
  engine_.set_wake(wake);
}

void App::cancel() {
  engine_.cancel();
  state_.timeline.play.kind = Playback::Kind::Off;
  if (state_.sequence) end_sequence("the sequence of pictures was cancelled", Message::Kind::Warning);
}

void App::post_by_itself(const std::string& line) { state_.commands.posted(line, engine_.post(line)); }

/// Restores the view that was saved with a session after it was opened.
void App::take_restored_view() {
  const std::string& view = session_->restored_view;
  const std::uint64_t serial = session_->restored_serial;
  if (serial == seen_restored_) return;
  seen_restored_ = serial;
  if (view.empty()) return;
  try {
    apply_view_json(view, state_, session_->input ? &session_->input->mesh : nullptr);
    const auto former = state_.run_names.former();
    for (PlotView& plot : state_.plots) rename_runs(plot, former);
    viewports_.forget_fit();
    state_.commands.keep_look(look());
  } catch (const UsageError& error) {
    Message message{Message::Kind::Error, fmt::format("the session is open, but its saved view could not be used: {}", error.what()),
                    error.exit_code()};
    if (listener_) listener_(message);
    add_message(state_, std::move(message));
  }
}

void App::advance_playback(double now) {
  Playback& play = state_.timeline.play;
  if (play.kind == Playback::Kind::Off) return;
  if (!engine_.busy()) {
    if (play.due <= 0.0) play.due = now;
    if (const auto line = next_command(play, *engine_.view(), now)) post_by_itself(*line);
  }
  if (play.kind != Playback::Kind::Off) redraw_in_ = std::min(redraw_in_, std::max(0.0, play.due - now));
}

void App::end_sequence(const std::string& outcome, Message::Kind kind) {
  const Sequence sequence = *std::exchange(state_.sequence, std::nullopt);
  state_.requests.screenshots.clear();
  const Moment& before = sequence.before;
  engine_.post(fmt::format("look-at {} {} {}", before.iteration, before.visits, before.edits));
  add_message(state_, {kind, outcome, kind == Message::Kind::Info ? 0 : 1});
}

/// Takes one step of the sequence under way, if any: seeks are not recorded, because it ends where it began.
void App::advance_sequence() {
  if (!state_.sequence) return;
  redraw_in_ = 0.0;
  Sequence& sequence = *state_.sequence;
  if (engine_.busy() || !viewports_.settled() || activity_.reduced) return;
  if (sequence.phase == Sequence::Phase::Shot) {
    if (!state_.requests.screenshots.empty()) return;
    if (state_.requests.screenshot_failed) return end_sequence("the sequence of pictures ended early", Message::Kind::Warning);
    ++sequence.done;
    sequence.phase = Sequence::Phase::Seek;
  }
  if (sequence.done == sequence.iterations.size()) {
    const std::filesystem::path& folder = sequence.options.folder;
    return end_sequence(fmt::format("saved {} pictures in {}\nfor a video: {}", sequence.done, folder.string(),
                                    video_line(folder, state_.timeline.play.speed)),
                        Message::Kind::Info);
  }
  const std::uint64_t wanted = sequence.iterations[sequence.done];
  if (sequence.phase == Sequence::Phase::Seek) {
    engine_.post(fmt::format("look-at {}", wanted));
    sequence.phase = Sequence::Phase::Wait;
    return;
  }
  const Frame* frame = session_->frame.get();
  if (frame == nullptr || frame->moment != Moment{wanted})
    return end_sequence(fmt::format("the sequence of pictures ended early: iteration {} cannot be shown", wanted), Message::Kind::Warning);
  const SequenceOptions& options = sequence.options;
  if (options.window && sequence.phase == Sequence::Phase::Wait) {
    sequence.phase = Sequence::Phase::Clean;
    return;
  }
  state_.requests.screenshot_failed = false;
  state_.requests.screenshots.push_back({sequence.next_file(), options.width, options.height, 2, false, options.window, true});
  sequence.phase = Sequence::Phase::Shot;
}

void App::submit_by_person(std::string_view line) {
  if (!ask_before(state_, *session_, engine_.current_command(), line)) submit(line);
}

void App::update_autosaved_view() { engine_.set_autosaved_view(view_json(state_)); }

/// Asks the person about unsaved work, or about work that was recovered.
void App::keep_safe(bool busy, double now) {
  if (const std::string line = go_on_leaving(state_, *session_, busy); !line.empty()) submit(line);
  if (!state_.recoverable.empty() && state_.dialog == Dialog::None) state_.dialog = Dialog::Recover;
  constexpr double kSeconds = 5.0;
  if (!engine_.autosaves() || now - view_kept_at_ < kSeconds) return;
  view_kept_at_ = now;
  update_autosaved_view();
}

void App::watch_file() {
  const bool wanted = state_.watch_file && session_->input && !session_->input->path.empty();
  if (!wanted && !watch_) return;
  if (!watch_)
    watch_ = std::make_unique<FileWatch>([wake = wake_] {
      if (wake) wake();
    });
  watch_->follow(wanted ? session_->input->path.string() : std::string());
  if (!state_.sequence && watch_->take_change()) post_by_itself("reload");
}

/// False also while the desktop's dialog is open: keys typed before it is seen are meant for it.
bool App::takes_commands() const {
  return !widgets_.chooser.open && !ImGui::GetIO().WantTextInput && state_.dialog == Dialog::None &&
         !ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
}

/// Whether an action waits: steps that are asked for faster than they are made are all made.
bool App::waits_its_turn(const Action& action) const {
  constexpr std::size_t kMost = 16;
  return is_step(action.command) && engine_.busy() && is_step(engine_.current_command()) && engine_.pending() < kMost;
}

void App::press(const KeyChord& chord, bool repeated) {
  constexpr int kKeypadMinus = 333, kKeypadPlus = 334;
  KeyChord known = chord;
  if (chord.code == kKeypadMinus) known.code = '-';
  if (chord.code == kKeypadPlus) known.code = '+';
  if (known.code == '+' && !known.ctrl && !known.alt) known.shift = false;  // "+" is on Shift on some keyboards
  const Action* action = action_of(known);
  if (action == nullptr || (repeated && !goes_on_while_held(*action))) return;
  Situation now = situation_of(*session_, state_, activity_.busy);
  if (!repeated && waits_its_turn(*action)) now.busy = false;
  if (!enabled(*action, now)) return;
  const std::size_t over = widgets_.run_list.over;  // with the mouse on a run, its key is for that run
  submit_by_person(action->key == "F2" && over > 0 ? fmt::format("begin-rename {}", over) : std::string(action->command));
}

}  // namespace dmoscope::ui
