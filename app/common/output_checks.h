#pragma once
// Finds out before long work whether its result can be written at all.

#include <filesystem>
#include <string_view>

namespace dmoscope::app {

/// Throws OutputError when nothing can be written to `path`: a folder, a device, a missing or read-only folder, a read-only file.
void require_writable(const std::filesystem::path& path);

/// Throws UsageError when `path`, the value of `option`, is the file `other` or one that a mesh there is read from, also through links and
/// when neither exists yet. An empty path is no file.
void require_another_file(const std::filesystem::path& path, std::string_view option, const std::filesystem::path& other);
/// Throws UsageError when `path`, the value of `option`, is a file that `mesh` is read from or that is written together with it.
void require_another_output(const std::filesystem::path& path, std::string_view option, const std::filesystem::path& mesh);

/// require_writable, and UsageError when no mesh format has this extension, or a file that `input` is read from would be overwritten,
/// unless it is `input` itself that is written. Where the format of `input` is unknown as well, that is reported instead (InputError),
/// since the output's extension is then not what has to be corrected.
void require_mesh_target(const std::filesystem::path& path, const std::filesystem::path& input = {});

}  // namespace dmoscope::app
