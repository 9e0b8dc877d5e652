#include "ui/commands/notice.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/run/ending.h"
#include "ui/commands/command_words.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

std::vector<FigureRow> rows_of(const ReportCard& card) {
  std::vector<FigureRow> rows{{}};
  const auto text = [](const CardFigure& figure, double value) {
    return figure.name.starts_with("below") ? fmt::format("{:.0f}", value) : fmt::format("{:.3f}", value);
  };
  for (std::size_t i = 0; i < card.figures.size();) {
    const std::string& of = card.figures[i].of;
    FigureRow before{of + " was", {}}, now{"is now", {}};
    for (; i < card.figures.size() && card.figures[i].of == of; ++i) {
      const CardFigure& figure = card.figures[i];
      if (of.empty()) continue;  // the sentence tells what is worse of the mesh itself
      if (rows.size() == 1) rows[0].cells.push_back({figure.name.starts_with("below") ? "<" + figure.name.substr(6) : figure.name});
      before.cells.push_back({text(figure, figure.before)});
      now.cells.push_back({text(figure, figure.after), figure.verdict});
    }
    if (of.empty()) continue;
    rows.push_back(std::move(before));
    rows.push_back(std::move(now));
  }
  return rows;
}

/// Tells what is worse than in the input, with a button for each option that keeps it or helps.
void tell_card(Notice& notice, const ReportCard& card) {
  if (card.verdict != Verdict::Worse) return;
  notice.sentences.push_back(card.sentence(false) + ".");
  notice.figures = rows_of(card);
  std::vector<std::string> offered;
  for (const CardFigure* figure : card.worse()) {
    const bool kept = !figure->kept_by.empty();
    const std::string& command = kept ? figure->kept_by : figure->helped_by;
    const bool has_button = command.empty() || command == "then mean" || std::ranges::find(offered, command) != offered.end();
    if (has_button) continue;  // the mean has a button of its own
    offered.push_back(command);
    notice.offers.push_back({fmt::format("notice:keep-{}", offered.size()), (kept ? "Keep: " : "Try: ") + command, command,
                             fmt::format("a new run beside this one, which {}: for that the minimum may rise less; Run starts it",
                                         kept ? "keeps it" : "usually ends with less of that")});
  }
}

void tell_ending(Notice& notice, const RunEnding& ending) {
  tell_card(notice, ending.card);
  if (ending.crossing) notice.sentences.push_back(ending.crossing->sentence());
  if (!ending.left) return;
  const LeftInverted& left = *ending.left;
  notice.sentences.push_back(left.sentence());
  notice.offers.push_back({"notice:element", fmt::format("Show element {}", left.element), fmt::format("goto element {}", left.element),
                           "the most inverted one: picks it and moves the view there"});
  notice.offers.push_back({"notice:vertex", fmt::format("Show vertex {}", left.vertex), fmt::format("goto vertex {}", left.vertex),
                           "the vertex of most of them: picks it and moves the view there"});
  if (!ending.hint) return;
  notice.sentences.push_back(ending.hint->sentence() + ".");
  notice.offers.push_back({"notice:method", "Try " + ending.hint->method, "method " + ending.hint->method,
                           "a new run by this method, beside this one; Run starts it"});
}

std::string as_sentence(std::string text) { return capitalised(std::move(text)) + "."; }

/// Tells what became worse, for a method that promises nothing.
void tell_worse(Notice& notice, const RunView& run) {
  const std::uint64_t at = run.moment.iteration;
  if (const std::string worse = made_worse(run.parameters, run.records.whole(), at); !worse.empty())
    notice.sentences.push_back(worse + ".");
  const std::string worse = worse_than_best(run.parameters, run.best_iteration, run.ended.value_or(at));
  if (worse.empty()) return;
  notice.sentences.push_back(worse + (run.ended ? "; the run is back there." : "."));
  if (run.ended) return;
  notice.offers.push_back({"notice:best", fmt::format("Go to {}", iteration_name(run.best_iteration)), "best",
                           "the best by inverted elements, minimum and mean; the run's later iterations stay on the timeline"});
}

/// Tells how much worse the others became while the worst element was raised.
void tell_mean_given_up(Notice& notice, const RunView& run) {
  const std::string fell = mean_given_up(run.parameters, run.records.whole(), run.moment.iteration);
  if (fell.empty()) return;
  const bool said = run.ending && run.ending->card.verdict == Verdict::Worse;
  if (!said) {
    notice.sentences.push_back(as_sentence(course_text(run.records.whole(), run.moment.iteration)));
    notice.sentences.push_back(as_sentence(fell));
  }
  if (run.ended)
    notice.sentences.push_back(
        fmt::format("The run went on to iteration {} and is back at {}, the best one: from there on the minimum rose "
                    "no more, and the mean fell.",
                    count(*run.ended), count(run.moment.iteration)));
  notice.offers.push_back({"notice:raise-mean", "Raise the mean", "raise-mean",
                           "then mean: a new run beside this one, which raises the mean once the minimum has converged, and keeps the "
                           "minimum; it starts at once"});
}

}  // namespace

Notice notice_of(const SessionView& session) {
  Notice notice;
  if (session.active >= session.runs.size()) return notice;
  const RunView& run = session.runs[session.active];
  if (run.last_outcome.empty()) return notice;
  notice.key = fmt::format("{} {} {}", run.id, run.moment.iteration, run.last_outcome);
  if (run.ending) tell_ending(notice, *run.ending);
  tell_worse(notice, run);
  tell_mean_given_up(notice, run);
  return notice;
}

void add_notice_command(CommandTable& table, ViewState& state, const CommandHost& host) {
  table.add({"notice", "notice off|on", "takes away what is said of the run's end, until another one ends; or shows it again"}, {1, 1},
            [&state, &host](Arguments words) {
              const bool on = switched(words, 0, true);
              const auto view = host.session();
              state.dismissed_notice = on || !view ? std::string() : notice_of(*view).key;
            });
}

}  // namespace dmoscope::ui
