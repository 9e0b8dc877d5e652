#pragma once
// Mesh files of lines: each rank reads the lines that begin in its part of the file, and writes them.

#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/io/reading/source_file.h"
#include "core/io/reading/tokenizer.h"
#include "mpi/files/shared_mesh_file.h"
#include "mpi/reading/byte_range.h"

namespace dmoscope {

/// The vertices of a rank's lines, and the places of their coordinates in its text.
struct VertexLines {
  std::vector<Vec3> positions;
  std::vector<std::uint64_t> places;
};

/// Greatest number of bytes before the first vertex, title and comments included, that a rank reads.
inline constexpr std::uint64_t kLongestHead = std::uint64_t{1} << 16U;

class TextMeshFile : public SharedMeshFile {
 public:
  TextMeshFile(const World& world, std::filesystem::path path, CoordinateLayout layout)
      : world_(world), path_(std::move(path)), layout_(std::move(layout)) {}
  [[nodiscard]] std::vector<std::string> write(const std::filesystem::path& target, std::span<const Vec3> positions) final;

 protected:
  /// Returns the rank's lines; all ranks together.
  [[nodiscard]] virtual LineBlock lines(const RangeFile& file) const = 0;
  /// Adds the vertices of lines, by this rank alone; in the order of the block of read().
  virtual void vertices(const LineBlock& lines, VertexLines& found) const = 0;

  /// Opens the file; read() calls it first.
  [[nodiscard]] const RangeFile& open();
  void close() { file_.reset(); }
  /// Checks the counts of lines: ranks take a line to end with a line feed. Throws InputError (as SharedError on all) if others count
  /// otherwise.
  void require_counts(const MeshBlock& block, std::uint64_t vertices, std::uint64_t elements) const;
  [[nodiscard]] const World& world() const noexcept { return world_; }
  [[nodiscard]] std::string name() const { return path_.string(); }
  /// Calls visit(tokens) with the tokens of a rank's lines.
  template <class Visit>
  void with_tokens(std::string_view text, std::size_t first_line, const Visit& visit) const {
    Progress unwatched;
    Tokenizer tokens(text, name(), layout_.syntax, unwatched);
    tokens.seek(0, first_line);
    visit(tokens);
  }
  /// Reads a count from the head. Throws InputError if it exceeds an Index.
  [[nodiscard]] static std::uint64_t read_count(Tokenizer& tokens, std::string_view what) {
    const std::int64_t found = tokens.read_integer(what);
    if (found < 0 || found >= std::int64_t{kNoIndex}) tokens.fail(fmt::format("{} out of range: {}", what, found));
    return static_cast<std::uint64_t>(found);
  }

 private:
  const World& world_;
  std::filesystem::path path_;
  CoordinateLayout layout_;
  std::optional<RangeFile> file_;
  std::int64_t stamp_ = 0;
};

/// Counts lines that hold more than blanks and a comment.
[[nodiscard]] std::uint64_t count_data_lines(std::string_view text, char comment);

}  // namespace dmoscope
