#pragma once
// A mesh file that many ranks read and write together, each a part of it.

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "mpi/mesh/mesh_block.h"

namespace dmoscope {

class SharedMeshFile {
 public:
  SharedMeshFile() = default;
  SharedMeshFile(const SharedMeshFile&) = delete;
  SharedMeshFile& operator=(const SharedMeshFile&) = delete;
  virtual ~SharedMeshFile() = default;
  /// Reads the file, all ranks together. Throws InputError (as SharedError on all).
  [[nodiscard]] virtual MeshBlock read(const FieldFilter& filter) = 0;
  /// Writes the file that was read under another name, or the same, with other positions; all else stays. `positions`: of the block's
  /// vertices, in its ranges. The target is unchanged until the new file is complete. To be called by all ranks together, after read().
  /// Throws OutputError, and InputError if the file read has changed since (as SharedError on all). Returns sentences about content of this
  /// rank's part that was not kept.
  [[nodiscard]] virtual std::vector<std::string> write(const std::filesystem::path& target, std::span<const Vec3> positions) = 0;
  /// Names of the nodal data, which move with the vertices; after read(), on the first rank.
  [[nodiscard]] virtual std::vector<std::string> nodal_fields() const { return {}; }
};

/// Makes the reader for the extension: .vtu, .pvtu, .obj, .off, .14 or .grd. Throws UsageError for others. `world` must outlive it.
[[nodiscard]] std::unique_ptr<SharedMeshFile> open_shared(const World& world, const std::filesystem::path& path);
/// Throws UsageError unless both have one format, which lets `output` be written after `input` was read.
void require_same_kind(const std::filesystem::path& input, const std::filesystem::path& output);

[[nodiscard]] std::unique_ptr<SharedMeshFile> open_shared_obj(const World& world, const std::filesystem::path& path);
[[nodiscard]] std::unique_ptr<SharedMeshFile> open_shared_off(const World& world, const std::filesystem::path& path);
[[nodiscard]] std::unique_ptr<SharedMeshFile> open_shared_fort14(const World& world, const std::filesystem::path& path);
[[nodiscard]] std::unique_ptr<SharedMeshFile> open_shared_vtu(const World& world, const std::filesystem::path& path);
[[nodiscard]] std::unique_ptr<SharedMeshFile> open_shared_pvtu(const World& world, const std::filesystem::path& path);

}  // namespace dmoscope
