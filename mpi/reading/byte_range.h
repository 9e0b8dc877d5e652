#pragma once
// Parts of a file that many ranks read together.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "mpi/world/world.h"

namespace dmoscope {

/// A file that is open for reading; any part of it can be had. Not moved.
class RangeFile {
 public:
  /// Throws InputError with the system's reason.
  explicit RangeFile(const std::filesystem::path& path);
  ~RangeFile();
  RangeFile(const RangeFile&) = delete;
  RangeFile& operator=(const RangeFile&) = delete;
  [[nodiscard]] std::uint64_t size() const noexcept { return size_; }
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  /// Fills `bytes` from `offset` on. Throws InputError when the file ends before, or has changed its size since it was opened.
  void read(std::uint64_t offset, std::span<char> bytes) const;
  [[nodiscard]] std::string read(std::uint64_t offset, std::uint64_t count) const;
  /// Throws InputError where the file is not the one of before: another size or time of change than `stamp`.
  void require_unchanged(std::int64_t stamp) const;
  /// Size and time of the last change in one number.
  [[nodiscard]] std::int64_t stamp() const noexcept { return stamp_; }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  std::int64_t stamp_ = 0;
};

/// The lines of a text that a rank reads: those that begin in its part of the file. Every line is one rank's.
struct LineBlock {
  std::string text;
  std::uint64_t offset = 0;      // of the text in the file
  std::uint64_t first_line = 1;  // its number in the file, from 1
};

/// Of the lines from byte `begin` on, a begin of a line. `joined`: a backslash before a line end joins two lines, which then stay together.
/// Throws what one rank alone meets (InputError) on all, see World::together().
[[nodiscard]] LineBlock read_lines(const World& world, const RangeFile& file, std::uint64_t begin, bool joined);

}  // namespace dmoscope
