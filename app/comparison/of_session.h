#pragma once
// The page of `dmoscope compare` for the runs of a session at their present iterations.

#include <filesystem>
#include <string>

#include "core/base/progress.h"
#include "core/session/session.h"

namespace dmoscope::app {

/// Writes the page, whole or not at all. Throws UsageError if no mesh is open, OutputError, Cancelled.
void write_report_of_session(Session& session, const std::filesystem::path& file, Progress& progress);

}  // namespace dmoscope::app
