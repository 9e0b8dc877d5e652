#pragma once
// One file that many ranks write parts of.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/writing/atomic_file.h"
#include "mpi/world/world.h"

namespace dmoscope {

/// A temporary file beside the target, which takes its name once all ranks have written their parts and these are on the disk. Written by
/// plain system calls: Open MPI's own functions for files have reported success on a full disk. All ranks call all but write() together.
class SharedOutput {
 public:
  /// Makes the temporary file, and room for it. Throws OutputError (as SharedError on all).
  SharedOutput(const World& world, const std::filesystem::path& target, std::uint64_t size);
  ~SharedOutput();
  SharedOutput(const SharedOutput&) = delete;
  SharedOutput& operator=(const SharedOutput&) = delete;
  /// Writes a part; this rank alone. Throws OutputError.
  void write(std::uint64_t offset, std::string_view bytes);
  /// Throws OutputError (as SharedError on all), with the target as it was. Returns, on rank 0, what replacing the target leaves undone.
  [[nodiscard]] std::vector<std::string> commit();

 private:
  [[noreturn]] void fail(int error) const;

  const World& world_;
  std::filesystem::path target_;
  std::unique_ptr<AtomicFile> file_;  // rank 0's
  int descriptor_ = -1;
};

}  // namespace dmoscope
