#pragma once
// What a person should know when a run has come to its end, and what can be done about it.

#include <string>
#include <vector>

#include "core/run/report_card.h"
#include "core/view/view.h"
#include "ui/commands/view_commands.h"

namespace dmoscope::ui {

struct Offer {
  std::string id;       // of its item: "best"
  std::string label;    // "Go to iteration 2"
  std::string command;  // one line
  std::string tooltip;
};

/// The report card's figures by one metric: in the input, and now.
struct FigureRow {
  struct Cell {
    std::string text;
    Verdict verdict = Verdict::Same;
  };
  std::string name;  // "mean ratio was", "is now"; of the head none
  std::vector<Cell> cells;
};

struct Notice {
  std::string key;  // the end that it is about; the same as more becomes known of it
  std::vector<std::string> sentences;
  std::vector<FigureRow> figures;  // a head and two rows a metric: where something is worse
  std::vector<Offer> offers;
  [[nodiscard]] bool empty() const noexcept { return sentences.empty(); }
};

/// Of the active run: what is worse than in the input, elements that stay inverted, that it has passed through a better iteration, and what
/// the mean lost. Empty where
/// nothing of this is so.
[[nodiscard]] Notice notice_of(const SessionView& session);

/// `notice off|on`: takes away the one that is on show, until another run ends; shows it again.
void add_notice_command(CommandTable& table, ViewState& state, const CommandHost& host);

}  // namespace dmoscope::ui
