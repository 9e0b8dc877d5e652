#pragma once
// Checks before long work that its result can be written.

#include <filesystem>
#include <string_view>

namespace dmoscope::app {

/// Throws OutputError if nothing can be written to `path`: a folder, a device, a missing or read-only folder, a read-only file.
void require_writable(const std::filesystem::path& path);

/// Throws UsageError if `path`, the value of `option`, is the file `other` or one that a mesh there is read from, also through links and if
/// neither exists yet. An empty path is no file.
void require_another_file(const std::filesystem::path& path, std::string_view option, const std::filesystem::path& other);
/// Throws UsageError if `path`, the value of `option`, is a file that `mesh` is read from or that is written together with it.
void require_another_output(const std::filesystem::path& path, std::string_view option, const std::filesystem::path& mesh);

/// Checks a mesh's target by require_writable; throws UsageError if no mesh format has this extension, or if a file that `input` is read
/// from, other than `input` itself, would be overwritten. If the format of `input` is unknown as well, that is reported instead
/// (InputError), since the output's extension is then not what has to be corrected.
void require_mesh_target(const std::filesystem::path& path, const std::filesystem::path& input = {});

}  // namespace dmoscope::app
