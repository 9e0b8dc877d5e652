#pragma once
// The bytes that a mesh was read from and the place of every coordinate in them, so that a moved mesh can be written with nothing else
// changed.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "core/base/memory.h"
#include "core/base/progress.h"
#include "core/base/vec.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {

enum class CoordinateScalar : std::uint8_t { Float32, Float64 };

/// Layout of a vertex's coordinates at its place in the file.
struct CoordinateLayout {
  bool binary = false;
  int components = 3;  // number of coordinates in the file: 2 (x y, z is 0) or 3
  /// Places of x, y and z relative to the vertex's place. Text: number of tokens before it; binary: number of bytes.
  std::array<std::uint32_t, 3> at{0, 1, 2};
  TextSyntax syntax;       // text: separators of tokens
  std::uint8_t width = 0;  // text: greatest number of characters of a number in the format; 0: any
  std::array<CoordinateScalar, 3> scalar{CoordinateScalar::Float64,  // types of x, y, z; text: as declared, more digits are possible
                                         CoordinateScalar::Float64, CoordinateScalar::Float64};
  bool big_endian = false;  // byte order of a binary file

  /// Layout in a binary file where x, y and perhaps z follow each other.
  [[nodiscard]] static CoordinateLayout packed(CoordinateScalar type, bool big_endian, int components = 3) {
    const std::uint32_t size = type == CoordinateScalar::Float32 ? 4 : 8;
    return {.binary = true,
            .components = components,
            .at = {0, size, 2 * size},
            .syntax = {},
            .scalar = {type, type, type},
            .big_endian = big_endian};
  }
};

/// The bytes of a file, in memory of their own.
class FileBytes {
 public:
  FileBytes() = default;
  explicit FileBytes(std::string_view bytes);
  [[nodiscard]] std::string_view view() const noexcept { return {data_.get(), size_}; }

  // --- Filling ---
  /// Uninitialised space behind the bytes, at least `most` of it.
  [[nodiscard]] std::span<char> room(std::size_t most);
  /// Counts `count` bytes of that space, which were filled, as the file's.
  void took(std::size_t count) noexcept { size_ += count; }

 private:
  struct Free {
    void operator()(char* bytes) const noexcept { std::free(bytes); }
  };
  std::unique_ptr<char, Free> data_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

struct Mesh;

/// A file as it was read. A reader fills in the layout, the places and the data that only the file holds; afterwards nothing changes it.
///
/// The file is read whole into memory: a mapping would crash the program if the file is truncated while it is open, and would show changes
/// while another program writes the file.
class SourceFile {
 public:
  SourceFile() = default;
  SourceFile(std::filesystem::path path, FileBytes bytes)
      : path_(std::move(path)), bytes_(std::move(bytes)), size_on_disk_(bytes_.view().size()) {}

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  [[nodiscard]] std::string_view bytes() const noexcept { return bytes_.view(); }
  /// Bytes of the file itself, which may be packed by gzip; UnpackBudget derives the memory limit for the contents from them.
  [[nodiscard]] std::size_t size_on_disk() const noexcept { return size_on_disk_; }
  /// Name of the format (FormatInfo::name) that it was read as.
  [[nodiscard]] std::string_view format() const noexcept { return format_; }
  [[nodiscard]] const CoordinateLayout& layout() const noexcept { return layout_; }

  /// The second file of a format with two (see CompanionFile in format.h); null for all others.
  [[nodiscard]] const SourceFile* companion() const noexcept { return companion_.get(); }

  /// Number of places with coordinates: one for each vertex, but more in formats that repeat vertices (STL).
  [[nodiscard]] std::size_t place_count() const noexcept { return stride_ != 0 ? uniform_count_ : places_.size(); }
  /// Byte offset of a place. Ascending.
  [[nodiscard]] std::uint64_t place(std::size_t i) const noexcept { return stride_ != 0 ? first_ + i * stride_ : places_[i]; }
  /// The vertex whose coordinates are at a place.
  [[nodiscard]] std::size_t vertex_at(std::size_t i) const noexcept { return place_vertices_.empty() ? i : place_vertices_[i]; }

  /// Reason why coordinates cannot be replaced in place (such as an integer scalar); empty if they can.
  [[nodiscard]] const std::string& not_patchable() const noexcept { return not_patchable_; }
  /// Data of the file that Mesh does not hold, in words that "... dropped" can follow: "vertex colours", "texture coordinates". They are
  /// kept when the same format is written, and named when another one is.
  [[nodiscard]] const std::vector<std::string>& only_in_file() const noexcept { return only_in_file_; }
  /// One sentence for each kind of data that the reader skipped and the user may miss ("3 line elements (l) are not shown").
  [[nodiscard]] const std::vector<std::string>& notes() const noexcept { return notes_; }

  /// A file beside this one whose fields were read with it, and which is never written; empty: none.
  [[nodiscard]] const std::string& beside() const noexcept { return beside_; }
  [[nodiscard]] std::size_t first_beside() const noexcept { return first_beside_; }  // see set_beside()
  /// The file that a field of the mesh was read from.
  [[nodiscard]] std::filesystem::path file_of_field(std::size_t field) const {
    return beside_.empty() || field < first_beside_ ? path_ : path_.parent_path() / beside_;
  }
  /// The rows of a field of the mesh from `row` on begin at a byte of their own, as in a file of several pieces.
  struct FieldPiece {
    std::uint64_t field, row, begin;
  };
  [[nodiscard]] const std::vector<FieldPiece>& field_pieces() const noexcept { return field_pieces_; }
  /// The 1-based line where a row of one of the mesh's fields begins; 0 where that is not known, as in binary files.
  [[nodiscard]] std::size_t line_of_row(const Mesh& mesh, std::size_t field, std::size_t row) const;

  // --- For readers of formats ---
  void set_size_on_disk(std::size_t size) { size_on_disk_ = size; }
  void set_format(std::string_view name) { format_ = name; }
  void set_companion(std::shared_ptr<const SourceFile> file) { companion_ = std::move(file); }
  void set_layout(const CoordinateLayout& layout) { layout_ = layout; }
  void reserve_places(std::size_t count) { reserve_large(places_, count); }
  void add_place(std::size_t offset) { places_.push_back(offset); }
  void add_places(std::span<const std::uint64_t> offsets) { places_.insert(places_.end(), offsets.begin(), offsets.end()); }
  /// Sets places at first, first + stride, ... (without memory for each); stride > 0.
  void set_uniform_places(std::size_t first, std::size_t stride, std::size_t count) {
    first_ = first;
    stride_ = stride;
    uniform_count_ = count;
  }
  /// Sets the vertex of each place, if it is not the i-th vertex at the i-th place.
  void set_place_vertices(std::vector<Index> vertices) { place_vertices_ = std::move(vertices); }
  /// Ascending.
  void add_field_piece(const FieldPiece& piece) { field_pieces_.push_back(piece); }
  void set_not_patchable(std::string why) { not_patchable_ = std::move(why); }
  /// Adds a kind of data, once for any number of calls.
  void add_only_in_file(std::string_view thing);
  void add_note(std::string sentence) { notes_.push_back(std::move(sentence)); }
  /// Sets the file beside this one. `first`: the first of the mesh's fields that are from that file.
  void set_beside(std::string file, std::size_t first) {
    beside_ = std::move(file);
    first_beside_ = first;
  }

  /// Passes all members to an archive, which saves or loads them.
  template <class Archive>
  friend void pass(Archive& archive, SourceFile& file) {
    archive(file.path_, file.bytes_, file.size_on_disk_, file.format_, file.beside_, file.first_beside_, file.not_patchable_, file.layout_,
            file.places_, file.first_, file.stride_, file.uniform_count_, file.place_vertices_, file.only_in_file_, file.notes_,
            file.field_pieces_, file.companion_);
  }

 private:
  std::filesystem::path path_;
  std::string beside_;
  std::size_t first_beside_ = 0;
  FileBytes bytes_;
  std::size_t size_on_disk_ = 0;
  std::string format_;
  std::shared_ptr<const SourceFile> companion_;
  CoordinateLayout layout_;
  std::vector<std::uint64_t> places_;
  std::uint64_t first_ = 0;
  std::uint64_t stride_ = 0;  // 0: places_ is used
  std::size_t uniform_count_ = 0;
  std::vector<Index> place_vertices_;
  std::string not_patchable_;
  std::vector<std::string> only_in_file_;
  std::unordered_set<std::string> met_only_in_file_;  // those of only_in_file_, for fast lookup
  std::vector<std::string> notes_;
  std::vector<FieldPiece> field_pieces_;
};

/// Reads a whole file. Throws InputError with the system's reason (missing, a directory, no permission), for anything but a regular file (a
/// pipe, a device), and for one of more than `most` bytes. Throws Cancelled.
[[nodiscard]] FileBytes read_whole_file(const std::filesystem::path& path, Progress& progress,
                                        std::size_t most = std::numeric_limits<std::size_t>::max());
/// Reads a small text of the user's or the program's own, of at most `most` bytes. Throws InputError.
[[nodiscard]] std::string read_small_text(const std::filesystem::path& path, std::size_t most);

}  // namespace dmoscope
