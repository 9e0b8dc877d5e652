#pragma once
// Saved sessions: meshes, runs, their moments and paths. JSON, so that others can read it.

#include <filesystem>
#include <memory>
#include <string>

#include "core/session/session_standing.h"

namespace dmoscope {

/// Writes the session, all or nothing. `view`: JSON of the view, saved as it is; empty: none. Throws UsageError if no mesh is open, if a
/// mesh cannot be found again (it came from no file and no generator), and for a view that is no JSON; OutputError.
void save_state(const std::filesystem::path& path, Session& session, const std::string& view, Progress& progress);
/// Writes a snapshot of a session; may be called on any thread.
void write_state(const std::filesystem::path& path, const SessionStanding& session, const std::string& view, Progress& progress);

/// Replaces meshes and runs by those of a file; every run is at its saved moment, bit for bit. Earlier iterations are recomputed on demand.
/// Every part of the file has a checksum, and recorded qualities must agree with the positions. On any error, and on Cancelled, the session
/// is unchanged. Throws InputError that names file and line if it is no saved session, is damaged (and which part) or does not fit
/// together, and for a mesh that has changed since; UsageError; DeviceError. Returns a sentence that the user should see, such as on an old
/// file without checksums; else nothing. `input`: the mesh if it was read already; null: it is read from the file's source.
std::string open_state(const std::filesystem::path& path, Session& session, Progress& progress,
                       const std::shared_ptr<const InputMesh>& input = nullptr);

}  // namespace dmoscope
