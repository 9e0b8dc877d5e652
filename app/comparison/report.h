#pragma once
// What `dmoscope compare` tells: a table for a person, one JSON object, files.

#include <string>
#include <vector>

#include "app/common/text.h"
#include "app/comparison/results.h"

namespace dmoscope::app {

/// What is reported besides the results.
struct ComparisonFacts {
  const CompareOptions& options;
  std::string goal;  // how far the runs went, in words
  unsigned threads;
  std::string command_line;  // empty: there was none
  std::vector<std::string> warnings;
};

/// The table, the spread of the orders, and what was left out.
[[nodiscard]] std::string text_of(const Comparison& comparison);
[[nodiscard]] Json json_of(const Comparison& comparison, const ComparisonFacts& facts);
/// As `dmoscope smooth --stats` has them, by the judge.
[[nodiscard]] std::string statistics_csv(const Comparison& comparison);
[[nodiscard]] std::string table_csv(const Comparison& comparison);
/// A page that stands alone. Throws Cancelled.
[[nodiscard]] std::string html_of(const Comparison& comparison, const ComparisonFacts& facts, const Progress& progress);

/// "40 iterations", "until converged: ...".
[[nodiscard]] std::string goal_sentence(const Goal& goal);
/// Version, commit, compiler, processor, date: what a figure depends on besides the code.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> machine_facts(unsigned threads);
/// A cell that sorts by its number; NaN and infinity come last.
struct PageCell;
[[nodiscard]] PageCell number_cell(std::string text, double value);

}  // namespace dmoscope::app
