#pragma once
// What came of smoothing a mesh, for a person and as JSON.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/common/provenance.h"
#include "app/common/quality_report.h"
#include "core/inspect/held_minimum.h"
#include "core/inspect/joint_hold.h"
#include "core/run/crossing_faces.h"
#include "core/run/ending.h"
#include "core/run/report_card.h"
#include "core/run/run.h"
#include "core/transfer/moved_fields.h"

namespace dmoscope::app {

/// Counts are of the whole mesh, however many processes have it.
struct SmoothReport {
  std::filesystem::path input, output;
  bool until_converged = false;
  const Run& run;
  std::uint64_t vertices = 0, elements = 0, free = 0, fixed_by_user = 0;
  std::uint64_t on_interfaces = 0;  // vertices that interfaces hold
  unsigned threads = 1;             // of this process
  unsigned ranks = 0;               // 0: one process alone
  Outcome outcome{};
  double seconds = 0.0;
  std::uint64_t inside_alone_before = 0;    // elements that only their inside inverted
  std::optional<LeftInverted> left{};       // of what is written
  std::optional<CrossingFaces> crossing{};  // likewise
  std::optional<ReportCard> card{};         // likewise; none where many processes have the mesh
  std::optional<HeldMinimum> held{};        // likewise
  MovedFields fields{};                     // nodal fields as they were written
  std::vector<std::string> warnings{};
  std::optional<Provenance> provenance{};

  [[nodiscard]] const IterationRecord& before() const { return run.history().records().front(); }
  /// What is written.
  [[nodiscard]] const IterationRecord& after() const { return run.history().records()[run.moment().iteration]; }
  [[nodiscard]] double visits_per_second() const {
    const auto visits = static_cast<double>(outcome.iterations * free);
    return seconds > 0.0 ? visits / seconds : 0.0;
  }
};

[[nodiscard]] Json card_json(const ReportCard& card);

/// Prints it, for a person or as JSON, and complains where the run has not converged as was asked.
void print_report(const SmoothReport& report, bool as_json);
/// Whether the run ended as was asked, with no element inverted; `strict`: and with nothing worse than in the input.
[[nodiscard]] bool all_well(const SmoothReport& report, bool strict);

/// Reads the word for the iteration that is written, "best" or "last". Throws UsageError.
void require_output_moment(const std::string& word);
/// Goes to the iteration that is written; returns a sentence where that is not the last though it was the last that was asked for.
[[nodiscard]] std::string seek_output_iteration(Run& run, const std::string& write, bool until_converged, Progress& progress);
/// The run's records as the text of a file, see stats_csv.
[[nodiscard]] std::string stats_of(const Run& run);
/// How long all iterations took.
[[nodiscard]] double smoothing_seconds(const Run& run);

}  // namespace dmoscope::app
