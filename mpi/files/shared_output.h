#pragma once
// One file of which many ranks write parts.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/writing/atomic_file.h"
#include "mpi/world/world.h"

namespace dmoscope {

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
