#pragma once
// Report of a smoothing run, for the user and as JSON.

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/common/provenance.h"
#include "app/common/quality_report.h"
#include "app/common/text.h"
#include "core/inspect/held_minimum.h"
#include "core/inspect/joint_hold.h"
#include "core/reference/surface_distance.h"
#include "core/run/crossing_faces.h"
#include "core/run/ending.h"
#include "core/run/report_card.h"
#include "core/run/run.h"
#include "core/transfer/moved_fields.h"

namespace dmoscope::app {

/// Results of smoothing. Counts are those of the whole mesh, for any number of processes.
struct SmoothReport {
  std::filesystem::path input, output;
  bool until_converged = false;
  const Run& run;
  std::uint64_t vertices = 0, elements = 0, free = 0, fixed_by_user = 0;
  std::uint64_t on_interfaces = 0;  // vertices that interfaces fix
  unsigned threads = 1;             // threads of this process
  unsigned ranks = 0;               // 0: one process alone
  Outcome outcome{};
  double seconds = 0.0;
  std::uint64_t inside_alone_before = 0;                // elements that are inverted inside alone
  std::optional<LeftInverted> left{};                   // in the positions that are written
  std::optional<CrossingFaces> crossing{};              // in the positions that are written
  std::optional<std::array<SurfaceDistance, 2>> fit{};  // before and after; none where nothing is drawn to a surface
  std::optional<ReportCard> card{};                     // about the positions that are written; none with many processes
  std::optional<HeldMinimum> held{};                    // at the positions that are written
  MovedFields fields{};                                 // nodal fields that are written
  std::vector<std::string> warnings{};
  std::optional<Provenance> provenance{};

  [[nodiscard]] const IterationRecord& before() const { return run.history().records().front(); }
  /// The record of the iteration that is written.
  [[nodiscard]] const IterationRecord& after() const { return run.history().records()[run.moment().iteration]; }
  [[nodiscard]] double visits_per_second() const {
    const auto visits = static_cast<double>(outcome.iterations * free);
    return seconds > 0.0 ? visits / seconds : 0.0;
  }
};

[[nodiscard]] Json card_json(const ReportCard& card);

/// Prints the report, for the user or as JSON, and complains if a run that was asked to converge has not.
void print_report(const SmoothReport& report, bool as_json);
/// Whether the run ended as asked, with no element inverted; `strict`: also with nothing worse than in the input.
[[nodiscard]] bool all_well(const SmoothReport& report, bool strict);

/// Checks the word for the iteration that is written, "best" or "last". Throws UsageError.
void require_output_moment(const std::string& word);
/// Goes to the iteration that is written; returns a sentence if that is not the last although the last was asked for.
[[nodiscard]] std::string seek_output_iteration(Run& run, const std::string& write, bool until_converged, Progress& progress);
/// The run's records as the text of a file, see stats_csv.
[[nodiscard]] std::string stats_of(const Run& run);
/// Time of all iterations, in seconds.
[[nodiscard]] double smoothing_seconds(const Run& run);

}  // namespace dmoscope::app
