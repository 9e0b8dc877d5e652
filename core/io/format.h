#pragma once
// Interface of a format (for readers and writers only; others use mesh_io.h), and functions that writers share.
//
// A new format is a source in a folder beside those of the others, with a FormatHandler that is declared below and listed in
// format_choice.cpp.

#include <array>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/mesh_io.h"
#include "core/io/reading/io_context.h"
#include "core/io/reading/source_file.h"
#include "core/io/writing/atomic_file.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

class TextBuffer;

/// Sentences for the user on data that a file could not hold.
using Notes = std::vector<std::string>;

/// A second file of a format beside the one with the coordinates, with the same name but an extension of its own.
struct CompanionFile {
  std::string_view main_extension;  // extension of the file with the coordinates, such as ".node"
  std::string_view extension;       // extension such as ".ele"; either of the two names both files
  /// Writes the file from scratch. FormatHandler::write was called before, and names the data that neither file can hold. Throws
  /// OutputError, Cancelled.
  void (*write)(AtomicFile& file, const Mesh& mesh, const IoContext& context);
};

/// Form of a comment at the end of a file, one line: text around it, and one that must not be in it. Empty: none is possible there.
struct CommentForm {
  std::string_view begin{}, end{}, without{};
};

struct FormatHandler {
  FormatInfo info;
  /// Whether these bytes certainly begin a file of this format, whatever its name. Null or false: the extension decides.
  bool (*recognises)(std::string_view bytes) = nullptr;
  /// Parses source.bytes() and fills in the source's layout, places, only_in_file and notes. Sets neither Mesh::name nor
  /// Mesh::source. Throws InputError, Cancelled.
  Mesh (*read)(SourceFile& source, const IoContext& context);
  /// Writes a new file from `mesh` at `positions`. Does not name data in SourceFile::only_in_file() (write_mesh does). Throws OutputError
  /// if the format cannot hold the mesh at all (its kinds of element, its z), Cancelled. Null: see not_written.
  Notes (*write)(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context) = nullptr;
  /// Writes mesh.source again with the numbers that changed. Null: write_patched() of patch_writer.h is used.
  Notes (*patch)(AtomicFile& file, const Mesh& mesh, const MovedMesh& moved, const IoContext& context) = nullptr;
  /// Second file of the format; null: it has one file. read() finds it as SourceFile::companion(), and patching writes its bytes unchanged.
  const CompanionFile* companion = nullptr;
  /// Further files that a mesh of this format is read from, besides a companion. Null: none. Throws InputError.
  std::vector<std::filesystem::path> (*further)(const SourceFile& source, const IoContext& context) = nullptr;
  /// Whether `file`, which is in the folder of `main`, has a name that the writer gives to files beside `main`. Null: never.
  bool (*writes_beside)(const std::filesystem::path& main, const std::filesystem::path& file) = nullptr;
  /// PLY and VTK have comments in the head only, STL has none; in a fort.14 further ADCIRC input may follow the boundaries.
  CommentForm comment{};
  /// Reason why no new file of this format is written, and the alternative.
  std::string_view not_written{};
};

extern const FormatHandler kOffFormat, kObjFormat, kPlyFormat, kStlFormat, kVtkFormat, kFort14Format, kSu2Format, kGmshFormat, kMeditFormat,
    kMeshbFormat, kTetgenFormat, kAbaqusFormat, kSms2dmFormat, kNastranFormat, kMikeFormat, kUnvFormat, kSelafinFormat, kExodusFormat;
// Formats that are not in every build: these need zlib and pugixml, the last ones HDF5.
extern const FormatHandler kVtuFormat, kVtpFormat, kPvtuFormat, kXdmfFormat;
extern const FormatHandler kCgnsFormat, kMedFormat;

/// Reads a file by a reader made for it: for FormatHandler::read.
template <class Reader>
Mesh read_with(SourceFile& source, const IoContext& context) {
  return Reader(source, context).read();
}

/// Writes a file by a writer made for it: for FormatHandler::write.
template <class Writer>
Notes write_with(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context) {
  return Writer(file, mesh, positions, context).write();
}

/// Files on disk of a mesh that a new one replaces.
class FormerMesh {
 public:
  /// Finds the files. `path`: as the user named it.
  explicit FormerMesh(std::filesystem::path path);
  /// Throws OutputError if `beside`, which is written with the mesh, exists and belonged to no mesh of that path.
  void require_own(const std::filesystem::path& beside) const;
  /// Removes pieces that the mesh no longer has, and notes what else is left. To be called once the new mesh is there.
  void settle(Notes& notes) const;

 private:
  std::filesystem::path path_;
  std::set<std::filesystem::path> files_;  // paths with all links followed
};

/// All formats, in the order of format_table().
[[nodiscard]] std::span<const FormatHandler* const> format_handlers();

/// Appends an element. Throws InputError if an Index could no longer count the corners of all elements.
void add_element(Mesh& mesh, ElementKind kind, std::span<const Index> corners, const SourceFile& source);

/// Corners of an element in the order of a file.
struct FileCorners {
  std::array<Index, 8> at{};
  std::size_t count = 0;
  [[nodiscard]] const Index* begin() const noexcept { return at.data(); }
  [[nodiscard]] const Index* end() const noexcept { return at.data() + count; }
  [[nodiscard]] const Index* data() const noexcept { return at.data(); }
  [[nodiscard]] std::size_t size() const noexcept { return count; }
  [[nodiscard]] Index operator[](std::size_t i) const noexcept { return at[i]; }
};
/// Corners of an element for a new file, in our order. Planar elements get the winding that they were read with (Mesh::flipped undone),
/// volume elements the positive one: inside out they are of no use.
[[nodiscard]] FileCorners file_corners(const Mesh& mesh, std::size_t element);
/// Writes the corners, counted from `base`, each behind a blank: " 5 8 7".
void put_corners(TextBuffer& out, const FileCorners& corners, Index base);

/// Throws OutputError if the mesh has volume elements: "... holds only triangles and quadrilaterals".
void require_surface_elements(const AtomicFile& file, const Mesh& mesh, std::string_view format_title);

/// Checks z for a format with only x and y: it must be equal everywhere; a z other than 0 is noted. Throws OutputError if z differs between
/// vertices.
void require_constant_z(const AtomicFile& file, std::span<const Vec3> positions, std::string_view format_title, Notes& notes);

/// Notes one sentence for each field or group that is not in `kept_fields` / `kept_groups` (indices into mesh.fields / mesh.groups).
void note_dropped(const Mesh& mesh, std::span<const std::size_t> kept_fields, std::span<const std::size_t> kept_groups,
                  std::string_view format_title, Notes& notes);

}  // namespace dmoscope
