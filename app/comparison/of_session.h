#pragma once
// The page of `dmoscope compare` for the runs of a session at their present iterations.

#include <filesystem>
#include <string>

#include "core/base/progress.h"
#include "core/session/session.h"

namespace dmoscope::app {

/// Makes the page about the runs on the active run's mesh, judged by the metric that is shown. Curves of runs by other metrics contain the
/// iterations known by it: the present one and those whose positions are kept.
[[nodiscard]] std::string report_of_session(Session& session, Progress& progress);

/// Writes the page, whole or not at all. Throws UsageError if no mesh is open, OutputError, Cancelled.
void write_report_of_session(Session& session, const std::filesystem::path& file, Progress& progress);

}  // namespace dmoscope::app
