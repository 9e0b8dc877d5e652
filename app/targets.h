#pragma once
// Finds out before long work whether its result can be written at all.

#include <filesystem>

namespace dmoscope::app {

/// Throws OutputError when nothing can be written to `path`: a folder, a device, a missing or read-only folder, a read-only file.
void require_writable(const std::filesystem::path& path);

/// require_writable, and UsageError when no mesh format has this extension.
void require_mesh_target(const std::filesystem::path& path);

}  // namespace dmoscope::app
