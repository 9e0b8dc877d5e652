#include "app/common/output_checks.h"

#include <string>

#include <fmt/format.h>
#include <unistd.h>

#include "core/base/error.h"
#include "core/io/mesh_io.h"
#include "core/io/writing/atomic_file.h"

namespace dmoscope::app {
void require_writable(const std::filesystem::path& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (error == std::errc::too_many_symbolic_link_levels) throw OutputError(path.string(), error.message());
  if (fs::is_directory(status)) throw OutputError(path.string(), "is a folder");
  if (fs::exists(status)) {
    if (!fs::is_regular_file(status)) throw OutputError(path.string(), "is not a regular file");
    if (access(path.c_str(), W_OK) != 0) throw OutputError(path.string(), "the file is write-protected");
  }
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error)) throw OutputError(path.string(), fmt::format("there is no folder '{}'", folder.string()));
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    throw OutputError(path.string(), fmt::format("the folder '{}' cannot be written to", folder.string()));
  }
}

void require_mesh_target(const std::filesystem::path& path, const std::filesystem::path& input) {
  const std::string extension = mesh_extension(path);
  if (format_by_extension(extension) != nullptr) {
    if (!same_mesh(path, input)) require_another_file(path, "output", input);
    return require_writable(path);
  }
  if (!input.empty()) {
    Progress unwatched;
    require_known_format(input, unwatched);
  }
  std::string known;
  for (const FormatInfo& format : format_table()) known += fmt::format("{}{}", known.empty() ? "" : " ", format.extensions);
  throw UsageError(fmt::format("{}: unknown extension '{}'; known are {}", path.string(), extension, known));
}

void require_another_file(const std::filesystem::path& path, std::string_view option, const std::filesystem::path& other) {
  if (same_file(path, other)) {
    throw UsageError(fmt::format("{} {}: this is the same file as {}, which it would overwrite", option, path.string(), other.string()));
  }
  const std::filesystem::path replaced = replaced_file(path, other);
  if (!replaced.empty())
    throw UsageError(
        fmt::format("{} {}: {} is read with {}, which would be overwritten", option, path.string(), replaced.string(), other.string()));
}

void require_another_output(const std::filesystem::path& path, std::string_view option, const std::filesystem::path& mesh) {
  require_another_file(path, option, mesh);
  if (!mesh.empty() && may_write(mesh, path))
    throw UsageError(fmt::format("{} {}: this is a file beside {}, which is written with it", option, path.string(), mesh.string()));
}

}  // namespace dmoscope::app
