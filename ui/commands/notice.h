#pragma once
// The note at the end of a run: what a person should know of it, and what can be done about it.

#include <string>
#include <vector>

#include "core/run/report_card.h"
#include "core/view/view.h"
#include "ui/commands/view_commands.h"

namespace dmoscope::ui {

struct Offer {
  std::string id;       // id of its item: "best"
  std::string label;    // "Go to iteration 2"
  std::string command;  // one command line
  std::string tooltip;
};

/// The report card's figures by one metric: in the input, and now.
struct FigureRow {
  struct Cell {
    std::string text;
    Verdict verdict = Verdict::Same;
  };
  std::string name;  // "mean ratio was", "is now"; empty for the head
  std::vector<Cell> cells;
};

struct Notice {
  std::string key;  // the end that it is about; it stays when more becomes known of that
  std::vector<std::string> sentences;
  std::vector<FigureRow> figures;  // a head and two rows for each metric by which something is worse
  std::vector<Offer> offers;
  [[nodiscard]] bool empty() const noexcept { return sentences.empty(); }
};

/// Note about the active run: figures worse than in the input, elements that stay inverted, a better iteration on the way, and loss of the
/// mean. Empty if there is none of these.
[[nodiscard]] Notice notice_of(const SessionView& session);

/// Adds `notice off|on`: hides the note until another run ends; shows it again.
void add_notice_command(CommandTable& table, ViewState& state, const CommandHost& host);

}  // namespace dmoscope::ui
