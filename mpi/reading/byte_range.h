#pragma once
// Parts of a file that many ranks read together.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "mpi/world/world.h"

namespace dmoscope {

/// A file that is open for reading, of which any part can be read. Not movable.
class RangeFile {
 public:
  /// Opens the file. Throws InputError with the system's reason.
  explicit RangeFile(const std::filesystem::path& path);
  ~RangeFile();
  RangeFile(const RangeFile&) = delete;
  RangeFile& operator=(const RangeFile&) = delete;
  [[nodiscard]] std::uint64_t size() const noexcept { return size_; }
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  /// Fills `bytes` from `offset` on. Throws InputError if the file ends before, or has changed its size since it was opened.
  void read(std::uint64_t offset, std::span<char> bytes) const;
  [[nodiscard]] std::string read(std::uint64_t offset, std::uint64_t count) const;
  /// Throws InputError if the file has changed: another size or time of change than in `stamp`.
  void require_unchanged(std::int64_t stamp) const;
  /// Size and time of the last change in one number.
  [[nodiscard]] std::int64_t stamp() const noexcept { return stamp_; }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  std::int64_t stamp_ = 0;
};

/// The lines of a text that a rank reads: those that begin in its part of the file. Every line belongs to one rank.
struct LineBlock {
  std::string text;
  std::uint64_t offset = 0;      // place of the text in the file
  std::uint64_t first_line = 1;  // number of its first line in the file, from 1
};

/// Reads this rank's lines after byte `begin`, the start of a line. `joined`: a backslash before a line end joins two lines, which then
/// stay together. Throws InputError of any rank on all, see World::together().
[[nodiscard]] LineBlock read_lines(const World& world, const RangeFile& file, std::uint64_t begin, bool joined);

}  // namespace dmoscope
