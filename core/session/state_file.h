#pragma once
// A session in a file: which mesh, which runs, where they stand and by which path. JSON, so that it can be read by others.

#include <filesystem>
#include <memory>
#include <string>

#include "core/session/session_standing.h"

namespace dmoscope {

/// Writes the session, all or nothing. `view`: JSON of whoever shows the session, kept as it is; empty: none. Throws UsageError where no
/// mesh is open, where nobody could find the mesh again (it came from no file and no generator), and for a view that is no JSON;
/// OutputError.
void save_state(const std::filesystem::path& path, Session& session, const std::string& view, Progress& progress);
/// The same of a session as it stood; may be done on any thread.
void write_state(const std::filesystem::path& path, const SessionStanding& session, const std::string& view, Progress& progress);

/// Replaces mesh and runs by those of a file; every run stands at its moment, bit for bit. Earlier iterations are computed again when asked
/// for. Every part of the file has a checksum, and the quality that it says of the positions must be theirs. On any error, and on
/// Cancelled, the session stays as it was. Throws InputError that names file and line for what is no state file, is damaged (and which part
/// of it) or does not fit together, and for a mesh that has changed since; UsageError; DeviceError. Returns a sentence where a person
/// should know more: an old file, without checksums; else nothing. `input`: the mesh where it was read already, so that it need not
/// be again; null: the file says where it is.
std::string open_state(const std::filesystem::path& path, Session& session, Progress& progress,
                       const std::shared_ptr<const InputMesh>& input = nullptr);

}  // namespace dmoscope
