#pragma once
// What a format has to give (for readers and writers only; others use mesh_io.h), and what writers share.
//
// A new format is a source in a folder beside those of the others, with a function `const FormatHandler& <name>_format()`, declared
// below and listed in format_choice.cpp.

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

/// Sentences for a person: what a file could not carry.
using Notes = std::vector<std::string>;

/// A second file that a format has beside the one with the coordinates, under the same name with an extension of its own.
struct CompanionFile {
  std::string_view main_extension;  // ".node": of the file with the coordinates
  std::string_view extension;       // ".ele"; either of the two names both files
  /// Makes it anew. FormatHandler::write was called before, and names what neither file can hold. Throws OutputError, Cancelled.
  void (*write)(AtomicFile& file, const Mesh& mesh, const IoContext& context);
};

struct FormatHandler {
  FormatInfo info;
  /// Do these bytes certainly begin a file of this format, whatever its name? Null or false: the extension decides.
  bool (*recognises)(std::string_view bytes);
  /// Parses source.bytes() and fills in the source's layout, places, only_in_file and notes. Sets neither Mesh::name nor
  /// Mesh::source. Throws InputError, Cancelled.
  Mesh (*read)(SourceFile& source, const IoContext& context);
  /// Makes a file anew from `mesh` at `positions`. Does not name what SourceFile::only_in_file() holds (write_mesh does).
  /// Throws OutputError if the format cannot hold the mesh at all (its kinds of element, its z), Cancelled.
  /// Null: see not_written.
  Notes (*write)(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context) = nullptr;
  /// Writes mesh.source again with the numbers that changed. Null: write_patched() of patch_writer.h.
  Notes (*patch)(AtomicFile& file, const Mesh& mesh, const MovedMesh& moved, const IoContext& context) = nullptr;
  /// Null: the format is one file. Otherwise read() finds it as SourceFile::companion(), and patching writes its bytes as they were.
  const CompanionFile* companion = nullptr;
  /// Further files that a mesh of this format is read from, besides a companion. Null: none. Throws InputError.
  std::vector<std::filesystem::path> (*further)(const SourceFile& source, const IoContext& context) = nullptr;
  /// Whether `file`, which lies in the folder of `main`, has a name that is given to what is written beside it. Null: never.
  bool (*writes_beside)(const std::filesystem::path& main, const std::filesystem::path& file) = nullptr;
  /// Why a file is not made anew, and what to write instead.
  std::string_view not_written{};
};

[[nodiscard]] const FormatHandler& off_format();
[[nodiscard]] const FormatHandler& obj_format();
[[nodiscard]] const FormatHandler& ply_format();
[[nodiscard]] const FormatHandler& stl_format();
[[nodiscard]] const FormatHandler& vtk_format();
[[nodiscard]] const FormatHandler& vtu_format();   // needs zlib and pugixml: not in every build
[[nodiscard]] const FormatHandler& vtp_format();   // likewise
[[nodiscard]] const FormatHandler& pvtu_format();  // likewise
[[nodiscard]] const FormatHandler& fort14_format();
[[nodiscard]] const FormatHandler& su2_format();
[[nodiscard]] const FormatHandler& gmsh_format();
[[nodiscard]] const FormatHandler& medit_format();
[[nodiscard]] const FormatHandler& meshb_format();
[[nodiscard]] const FormatHandler& tetgen_format();
[[nodiscard]] const FormatHandler& abaqus_format();
[[nodiscard]] const FormatHandler& sms_2dm_format();
[[nodiscard]] const FormatHandler& nastran_format();
[[nodiscard]] const FormatHandler& mike_format();
[[nodiscard]] const FormatHandler& selafin_format();
[[nodiscard]] const FormatHandler& xdmf_format();  // needs pugixml: not in every build
[[nodiscard]] const FormatHandler& exodus_format();
[[nodiscard]] const FormatHandler& cgns_format();  // needs HDF5: not in every build

/// The files of a mesh on the disk that a new one replaces.
class FormerMesh {
 public:
  /// `path`: as the person named it.
  explicit FormerMesh(std::filesystem::path path);
  /// Throws OutputError where `beside`, which is written with the mesh, is there and belonged to no mesh of that path.
  void require_own(const std::filesystem::path& beside) const;
  /// Once the new mesh is there: removes the pieces that it no longer has, and tells what else is left.
  void settle(Notes& notes) const;

 private:
  std::filesystem::path path_;
  std::set<std::filesystem::path> files_;  // all links followed
};

/// All of them, in the order of format_table().
[[nodiscard]] std::span<const FormatHandler* const> format_handlers();

/// Appends an element. Throws InputError when the corners of all elements would no longer be counted by an Index.
void add_element(Mesh& mesh, ElementKind kind, std::span<const Index> corners, const SourceFile& source);

/// Corners of an element as a file has them.
struct FileCorners {
  std::array<Index, 8> at{};
  std::size_t count = 0;
  [[nodiscard]] const Index* begin() const noexcept { return at.data(); }
  [[nodiscard]] const Index* end() const noexcept { return at.data() + count; }
  [[nodiscard]] const Index* data() const noexcept { return at.data(); }
  [[nodiscard]] std::size_t size() const noexcept { return count; }
  [[nodiscard]] Index operator[](std::size_t i) const noexcept { return at[i]; }
};
/// Those of a file that is made anew, in our order. In the plane they go out in the winding that they came in (Mesh::flipped undone),
/// volume elements the right way round: inside out they are of no use.
[[nodiscard]] FileCorners file_corners(const Mesh& mesh, std::size_t element);
/// Writes " 5 8 7": the corners, counted from `base`, each behind a blank.
void put_corners(TextBuffer& out, const FileCorners& corners, Index base);

/// Throws OutputError if the mesh has an element of three dimensions: "... holds only triangles and quadrilaterals".
void require_surface_elements(const AtomicFile& file, const Mesh& mesh, std::string_view format_title);

/// For a format with only x and y: z must be the same everywhere; a z other than 0 is named in the notes.
/// Throws OutputError if z differs between vertices.
void require_constant_z(const AtomicFile& file, std::span<const Vec3> positions, std::string_view format_title, Notes& notes);

/// One sentence for each field or group that is not in `kept_fields` / `kept_groups` (indices into mesh.fields / mesh.groups).
void note_dropped(const Mesh& mesh, std::span<const std::size_t> kept_fields, std::span<const std::size_t> kept_groups,
                  std::string_view format_title, Notes& notes);

}  // namespace dmoscope
