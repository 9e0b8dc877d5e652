#pragma once
// A mesh file that many ranks read and write together, each a part of it.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/writing/atomic_file.h"
#include "mpi/mesh/mesh_block.h"
#include "mpi/world/world.h"

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

// One file of which many ranks write parts.

/// A temporary file beside the target, renamed to it once all ranks have written their parts and these are on the disk. Written by plain
/// system calls: Open MPI's own functions for files have reported success on a full disk. All members but write() are called by all ranks
/// together.
class SharedOutput {
 public:
  /// Makes the temporary file, and reserves room for it. Throws OutputError (as SharedError on all).
  SharedOutput(const World& world, const std::filesystem::path& target, std::uint64_t size);
  ~SharedOutput();
  SharedOutput(const SharedOutput&) = delete;
  SharedOutput& operator=(const SharedOutput&) = delete;
  /// Writes a part, from this rank alone. Throws OutputError.
  void write(std::uint64_t offset, std::string_view bytes);
  /// Replaces the target by the temporary file. Throws OutputError (as SharedError on all), and leaves the target unchanged then. Returns,
  /// on rank 0, sentences about content that replacing the target leaves behind.
  [[nodiscard]] std::vector<std::string> commit();

 private:
  [[noreturn]] void fail(int error) const;

  const World& world_;
  std::filesystem::path target_;
  std::unique_ptr<AtomicFile> file_;  // rank 0's
  int descriptor_ = -1;
};

}  // namespace dmoscope
