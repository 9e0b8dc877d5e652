#pragma once
// Reading and writing of meshes: one reader and writer for each format, behind one table.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/reading/io_context.h"
#include "core/mesh/mesh.h"
#include "core/mesh/moved_mesh.h"

namespace dmoscope {

struct FormatInfo {
  std::string_view name;        // name such as "vtk"
  std::string_view title;       // title such as "VTK legacy"
  std::string_view extensions;  // extension such as ".vtk", several separated by spaces
  std::string_view doc;         // contents that it can hold, one line
};
/// All formats that the program reads or writes.
[[nodiscard]] std::span<const FormatInfo> format_table();
/// The format with this extension (".off", in whatever case), null if there is none.
[[nodiscard]] const FormatInfo* format_by_extension(std::string_view extension);

/// The extension that determines the format of a file: ".vtk" for a.vtk and for a.vtk.gz.
[[nodiscard]] std::string mesh_extension(const std::filesystem::path& path);

/// Reads a mesh, which may be packed by gzip, of a format determined by content if that is certain, else by extension. Positions are the
/// file's exact doubles, vertices and elements in the file's order; nothing is normalised. Throws InputError (file and line), Cancelled.
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& path, const IoContext& context);

/// Every file that the mesh at `path` is read from, itself first: its second file, the pieces that it names, the file with its numbers, the
/// one with its fields. For a path that is missing or no mesh: the path, and its second file if the extension has one.
[[nodiscard]] std::vector<std::filesystem::path> mesh_files(const std::filesystem::path& path);
/// Whether two paths name one mesh, also by either file of a format with two files.
[[nodiscard]] bool same_mesh(const std::filesystem::path& a, const std::filesystem::path& b);
/// Whether writing to `target`, a mesh or anything else, may write `file`: itself, or a file beside it.
[[nodiscard]] bool may_write(const std::filesystem::path& target, const std::filesystem::path& file);
/// The file of the mesh `read` that writing to `target` may replace; empty: none.
[[nodiscard]] std::filesystem::path replaced_file(const std::filesystem::path& target, const std::filesystem::path& read);

/// The format in which a mesh is written: that of the extension or, if the mesh's file has the same extension but its content is of another
/// format, that of the file. Null: none has this extension.
[[nodiscard]] const FormatInfo* written_format(const std::filesystem::path& path, const Mesh& mesh);

/// Throws InputError if read_mesh() would not recognise the format of the file, with the same message; Cancelled.
void require_known_format(const std::filesystem::path& path, const IoContext& context);

/// Writes `mesh`, changed as `moved` says, to `path`, in the written_format(), packed by gzip if its name ends with .gz. If mesh.source is
/// of that format, its bytes are written again and only the numbers whose bits changed are replaced; otherwise a new file is written:
/// planar elements in the winding that they were read with (mesh.flipped undone), volume elements as the format demands. Written beside the
/// target and renamed: on any failure the old file is unchanged. Both files of a format of two (.node, .ele) are read and written,
/// whichever is named. No file that the mesh was read from is replaced, except its own when it is written to its own path; nor is one
/// beside the target that did not belong to it. Returns one sentence for each kind of data that the format could not hold. Throws
/// OutputError, UsageError (unknown extension), Cancelled.
std::vector<std::string> write_mesh(const std::filesystem::path& path, const Mesh& mesh, const MovedMesh& moved, const IoContext& context);

/// Writes a mesh like write_mesh() with a comment at the file's end (empty: none). For a format without comments a sentence is added to
/// those returned.
std::vector<std::string> write_commented_mesh(const std::filesystem::path& path, const Mesh& mesh, const MovedMesh& moved,
                                              const IoContext& context, std::string_view comment);

/// Whether write_mesh() writes the bytes of mesh.source to `path` again, with changed coordinates replaced; mesh.positions must be the
/// file's own. Otherwise it writes a new file.
[[nodiscard]] bool writes_source_again(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace dmoscope
