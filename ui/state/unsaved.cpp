#include "ui/state/unsaved.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/commands/commands.h"

namespace dmoscope::ui {

std::vector<std::size_t> unsaved_runs(const SessionView& session) {
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < session.runs.size(); ++k)
    if (session.runs[k].unsaved) places.push_back(k);
  return places;
}

std::string window_title(const SessionView& session) {
  if (!session.input) return "dmoscope";
  return fmt::format("{}{} – dmoscope", unsaved_runs(session).empty() ? "" : "• ", session.input->mesh.name);
}

bool gives_up_session(std::string_view line) {
  constexpr std::array<std::string_view, 6> kSuch{"quit", "open", "open-session", "open-state", "generate", "recover"};
  try {
    const std::vector<std::string> words = split_words(line);
    return !words.empty() && std::ranges::find(kSuch, words.front()) != kSuch.end();
  } catch (const Error&) {
    return false;  // the line has no effect
  }
}

UnsavedQuestion unsaved_question(const SessionView& session, const Leaving& leaving, bool busy, const std::string& command) {
  UnsavedQuestion question;
  question.title = leaving.line == "quit" ? "Quit without saving?" : "Open another mesh without saving this one?";
  constexpr std::size_t kNamed = 5;
  const std::vector<std::size_t> places = unsaved_runs(session);
  for (const std::size_t place : places) {
    if (question.lines.size() == kNamed && places.size() > kNamed + 1) {
      question.lines.push_back(fmt::format("and {} more runs", places.size() - kNamed));
      break;
    }
    const RunView& run = session.runs[place];
    std::string where = fmt::format("iteration {}", run.moment.iteration);
    if (run.moment.visits > 0) where += fmt::format(" and {} visit{}", run.moment.visits, run.moment.visits == 1 ? "" : "s");
    question.lines.push_back(fmt::format("{}: {}", run.title, where));
  }
  if (busy)
    question.running = fmt::format("\"{}\" is going on. Cancel lets it go on; any other answer stops it where it is, between two vertices.",
                                   command.substr(0, command.find(' ', command.find(' ') + 1)));
  return question;
}

}  // namespace dmoscope::ui
