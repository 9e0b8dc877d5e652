#pragma once
// Interface of a format (for readers and writers only; others use mesh_io.h), and functions that writers share.
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

struct FormatHandler {
  FormatInfo info;
  /// Whether these bytes certainly begin a file of this format, whatever its name. Null or false: the extension decides.
  bool (*recognises)(std::string_view bytes);
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
  /// Reason why no new file of this format is written, and the alternative.
  std::string_view not_written{};
};

[[nodiscard]] const FormatHandler& off_format();
[[nodiscard]] const FormatHandler& obj_format();
[[nodiscard]] const FormatHandler& ply_format();
[[nodiscard]] const FormatHandler& stl_format();
[[nodiscard]] const FormatHandler& vtk_format();
[[nodiscard]] const FormatHandler& vtu_format();   // needs zlib and pugixml: not in every build
[[nodiscard]] const FormatHandler& vtp_format();   // needs zlib and pugixml: not in every build
[[nodiscard]] const FormatHandler& pvtu_format();  // needs zlib and pugixml: not in every build
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
[[nodiscard]] const FormatHandler& unv_format();
[[nodiscard]] const FormatHandler& selafin_format();
[[nodiscard]] const FormatHandler& xdmf_format();  // needs pugixml: not in every build
[[nodiscard]] const FormatHandler& exodus_format();
[[nodiscard]] const FormatHandler& cgns_format();  // needs HDF5: not in every build
[[nodiscard]] const FormatHandler& med_format();   // needs HDF5: not in every build

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
