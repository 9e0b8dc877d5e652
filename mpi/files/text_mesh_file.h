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
  [[nodiscard]] const RangeFile& file() const { return *file_; }
  void close() { file_.reset(); }
  [[nodiscard]] const TextSyntax& syntax() const noexcept { return layout_.syntax; }
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

/// A file whose head says how many lines of vertices and of elements follow.
class CountedMeshFile : public TextMeshFile {
 public:
  using TextMeshFile::TextMeshFile;

 protected:
  /// Reads the counts of vertices and elements, and the rest of the head.
  virtual void read_head(Tokenizer& tokens, std::uint64_t& vertices, std::uint64_t& elements) = 0;
  [[nodiscard]] LineBlock lines(const RangeFile& file) const final { return read_lines(world(), file, body_, false); }

  /// Opens the file, reads the head, and returns the rank's lines after it; all ranks together. `elements`: their name in messages.
  [[nodiscard]] LineBlock read_body(std::string_view elements);
  /// Calls visit(tokens, line) for the rank's lines, by their numbers among all lines after the head, until it returns false.
  template <class Visit>
  void each_line(const LineBlock& lines, const Visit& visit) const {
    with_tokens(lines.text, lines.first_line, [&](Tokenizer& tokens) {
      for (std::uint64_t i = first_; !tokens.at_end() && visit(tokens, i); ++i) {
      }
    });
  }
  /// Makes a block of what the ranks have read of it.
  [[nodiscard]] MeshBlock block_of(std::vector<Vec3> positions, std::vector<ElementKind> kinds) const;

  std::uint64_t vertices_ = 0, elements_ = 0;

 private:
  std::uint64_t body_ = 0;   // start of the lines after the head
  std::uint64_t first_ = 0;  // number of the rank's first line among those
};

}  // namespace dmoscope
