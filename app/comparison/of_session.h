#pragma once
// The page of `dmoscope compare` about the runs of a session, as they stand.

#include <filesystem>
#include <string>

#include "core/base/progress.h"
#include "core/session/session.h"

namespace dmoscope::app {

/// How the runs on the active run's mesh compare, judged by the metric that is shown. Courses of runs by other metrics are those of the
/// iterations that are known by it: where they stand and whose positions are kept.
[[nodiscard]] std::string report_of_session(Session& session, Progress& progress);

/// Writes it, whole or not at all. Throws UsageError where no mesh is open, OutputError, Cancelled.
void write_report_of_session(Session& session, const std::filesystem::path& file, Progress& progress);

}  // namespace dmoscope::app
