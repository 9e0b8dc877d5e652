#pragma once
// Mesh files of lines: each rank reads the lines that begin in its part of the file, and writes them again.

#include <optional>
#include <string_view>
#include <vector>

#include "core/io/reading/source_file.h"
#include "mpi/files/shared_mesh_file.h"
#include "mpi/reading/byte_range.h"

namespace dmoscope {

/// The vertices of a rank's lines, and where their coordinates stand in its text.
struct VertexLines {
  std::vector<Vec3> positions;
  std::vector<std::uint64_t> places;
};

/// Bytes before the first vertex, title and comments included, that a rank looks at.
inline constexpr std::uint64_t kLongestHead = std::uint64_t{1} << 16U;

class TextMeshFile : public SharedMeshFile {
 public:
  TextMeshFile(const World& world, std::filesystem::path path) : world_(world), path_(std::move(path)) {}
  [[nodiscard]] std::vector<std::string> write(const std::filesystem::path& target, std::span<const Vec3> positions) final;

 protected:
  /// The rank's lines; all ranks together.
  [[nodiscard]] virtual LineBlock lines(const RangeFile& file) const = 0;
  /// Adds the vertices of these, this rank alone; in the order of the block that read() gives.
  virtual void vertices(const LineBlock& lines, VertexLines& found) const = 0;
  [[nodiscard]] virtual CoordinateLayout layout() const = 0;

  /// Opens the file; read() calls it first.
  [[nodiscard]] const RangeFile& open();
  void close() { file_.reset(); }
  /// Ranks take a line to end with a line feed. Throws InputError (as SharedError on all) where others count otherwise.
  void require_counts(const MeshBlock& block, std::uint64_t vertices, std::uint64_t elements) const;
  [[nodiscard]] const World& world() const noexcept { return world_; }
  [[nodiscard]] std::string name() const { return path_.string(); }

 private:
  const World& world_;
  std::filesystem::path path_;
  std::optional<RangeFile> file_;
  std::int64_t stamp_ = 0;
};

/// Lines that hold more than blanks and a comment.
[[nodiscard]] std::uint64_t count_data_lines(std::string_view text, char comment);

}  // namespace dmoscope
