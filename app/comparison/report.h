#pragma once
// Output of `dmoscope compare`: a table, one JSON object, files.

#include <string>
#include <vector>

#include "app/common/text.h"
#include "app/comparison/results.h"

namespace dmoscope::app {

/// Facts of a report besides the results.
struct ComparisonFacts {
  const CompareOptions& options;
  std::string goal;  // the end of the runs, in words
  unsigned threads;
  std::string command_line;  // empty: not started by a command line
  std::vector<std::string> warnings;
};

/// The report as text: the table, the spread of the orders, and what was left out.
[[nodiscard]] std::string text_of(const Comparison& comparison);
[[nodiscard]] Json json_of(const Comparison& comparison, const ComparisonFacts& facts);
/// The statistics of all iterations, in the format of `dmoscope smooth --stats`, by the judge.
[[nodiscard]] std::string statistics_csv(const Comparison& comparison);
[[nodiscard]] std::string table_csv(const Comparison& comparison);
/// The report as a page without other files. Throws Cancelled.
[[nodiscard]] std::string html_of(const Comparison& comparison, const ComparisonFacts& facts, const Progress& progress);

/// The goal in words: "40 iterations", "until converged: ...".
[[nodiscard]] std::string goal_sentence(const Goal& goal);
/// Conditions of a figure besides the code: version, commit, compiler, processor, date.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> machine_facts(unsigned threads);
/// A cell that sorts by its number; NaN and infinity come last.
struct PageCell;
[[nodiscard]] PageCell number_cell(std::string text, double value);

}  // namespace dmoscope::app
