#include "ui/commands/unsaved_commands.h"

#include <utility>

#include "ui/commands/command_words.h"

namespace dmoscope::ui {
namespace {

enum class Answer { Session, Export, Discard, Cancel };
enum class Recovery { Take, Discard, Later };

void answer(ViewState& state, const CommandHost& host, Answer given) {
  if (!state.leaving) throw UsageError("nothing is asked");
  if (given == Answer::Cancel) {
    state.leaving.reset();
    state.dialog = Dialog::None;
    return;
  }
  if (host.busy()) host.cancel();  // its present state is saved
  state.leaving->phase = given == Answer::Discard ? Leaving::Phase::Going : Leaving::Phase::Saving;
  state.dialog = given == Answer::Discard ? Dialog::None : given == Answer::Session ? Dialog::SaveSession : Dialog::Export;
}

void recovery(ViewState& state, const CommandHost& host, Recovery wish, std::size_t place) {
  if (place >= state.recoverable.size()) throw UsageError("there is nothing to recover");
  if (wish == Recovery::Later) {
    state.recoverable.clear();  // leaves them: the next start offers them again
  } else if (wish == Recovery::Discard) {
    remove_safe(state.recoverable[place].names);
    state.recoverable.erase(state.recoverable.begin() + static_cast<std::ptrdiff_t>(place));
  } else {
    // It is kept until this window has saved the session automatically.
    state.recovering = state.recoverable[place];
    state.recoverable.clear();
    host.post("recover " + quote_word(state.recovering->names.session.string()));
  }
  if (state.recoverable.empty()) state.dialog = Dialog::None;
}

}  // namespace

void add_unsaved_commands(CommandTable& table, ViewState& state, const CommandHost& host) {
  table.add({"answer", "answer session|export|discard|cancel", "answers that question"}, {1, 1}, [&state, &host](Arguments words) {
    static constexpr std::array<std::pair<std::string_view, Answer>, 4> answers{
        {{"session", Answer::Session}, {"export", Answer::Export}, {"discard", Answer::Discard}, {"cancel", Answer::Cancel}}};
    answer(state, host, choose(words[0], answers));
  });
  table.add({"recovery", "recovery take|discard|later [K]", "what becomes of a session that a window left behind"}, {1, 2},
            [&state, &host](Arguments words) {
              static constexpr std::array<std::pair<std::string_view, Recovery>, 3> wishes{
                  {{"take", Recovery::Take}, {"discard", Recovery::Discard}, {"later", Recovery::Later}}};
              recovery(state, host, choose(words[0], wishes), words.size() > 1 ? to_count(words[1], 1) - 1 : 0);
            });
}

bool ask_before(ViewState& state, const SessionView& session, const std::string& at_work, std::string_view line) {
  if (!state.asks_unsaved || !gives_up_session(line)) return false;
  // A command that has just begun may have moved vertices that no view shows yet.
  const bool moving = session.input && !at_work.empty() && !gives_up_session(at_work);
  if (unsaved_runs(session).empty() && !moving) return false;
  state.leaving = Leaving{std::string(line), Leaving::Phase::Asking};
  state.dialog = Dialog::Unsaved;
  return true;
}

std::string go_on_leaving(ViewState& state, const SessionView& session, bool busy) {
  if (!state.leaving) return {};
  if (state.leaving->phase == Leaving::Phase::Asking) {
    if (state.dialog == Dialog::None) state.leaving.reset();  // the dialog was closed by Escape
    return {};
  }
  const bool go = state.leaving->phase == Leaving::Phase::Going;
  if (!go && (busy || state.dialog != Dialog::None)) return {};
  if (go || unsaved_runs(session).empty()) return std::exchange(state.leaving, std::nullopt)->line;
  state.leaving->phase = Leaving::Phase::Asking;
  state.dialog = Dialog::Unsaved;
  return {};
}

}  // namespace dmoscope::ui
