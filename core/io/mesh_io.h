#pragma once
// Reading and writing meshes: one reader and writer per format, behind one table.

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
  std::string_view name;        // "vtk"
  std::string_view title;       // "VTK legacy"
  std::string_view extensions;  // ".vtk", several separated by spaces
  std::string_view doc;         // what it can carry, one line
};
/// Every format the program reads and writes.
[[nodiscard]] std::span<const FormatInfo> format_table();
/// The format with this extension (".off", whatever its case), null if there is none.
[[nodiscard]] const FormatInfo* format_by_extension(std::string_view extension);

/// The extension that tells the format of a file: ".vtk" of a.vtk and of a.vtk.gz.
[[nodiscard]] std::string mesh_extension(const std::filesystem::path& path);

/// Reads a mesh, which may be packed by gzip, format by content where that is certain, else by extension. Positions are the file's exact
/// doubles, vertices and elements in the file's order; nothing is normalised. Throws InputError (file and line), Cancelled.
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& path, const IoContext& context);

/// Every file that the mesh at `path` is read from, itself first: its second file, the pieces that it names, the file with its numbers, the
/// one with its fields. Of what is not there or is no mesh: the path, and its second file where the extension has one.
[[nodiscard]] std::vector<std::filesystem::path> mesh_files(const std::filesystem::path& path);
/// Whether the two name one mesh, also by either file of a format that has two.
[[nodiscard]] bool same_mesh(const std::filesystem::path& a, const std::filesystem::path& b);
/// Whether writing to `target`, a mesh or anything else, may write `file`: itself, or what a mesh has beside it.
[[nodiscard]] bool may_write(const std::filesystem::path& target, const std::filesystem::path& file);
/// The file of the mesh `read` that writing to `target` may take the place of; empty: none.
[[nodiscard]] std::filesystem::path replaced_file(const std::filesystem::path& target, const std::filesystem::path& read);

/// The format that a mesh is written in: that of the extension, but that of the mesh's file where this has the same extension and was read
/// as another format for what it holds. Null: none has this extension.
[[nodiscard]] const FormatInfo* written_format(const std::filesystem::path& path, const Mesh& mesh);

/// Throws InputError where read_mesh() would not know what format the file is, with the same words; Cancelled.
void require_known_format(const std::filesystem::path& path, const IoContext& context);

/// Writes `mesh` with what it becomes in place of its own to `path`, in the written_format(), packed by gzip where its name ends with .gz.
/// When mesh.source is of that format, its bytes are written again and only the numbers whose bits changed are replaced;
/// otherwise the file is made anew: elements of the plane in the winding that they came in (mesh.flipped undone), volume elements as the
/// format wants them. Written beside the target and renamed: on any failure the old file stands. A format of two files (.node, .ele) is
/// read and written as both, whichever is named. No file that the mesh was read from is replaced, but those of itself when it is written to
/// its own path; nor is one beside the target that did not belong to it. Returns one sentence for each thing the format could not carry.
/// Throws OutputError, UsageError (unknown extension), Cancelled.
std::vector<std::string> write_mesh(const std::filesystem::path& path, const Mesh& mesh, const MovedMesh& moved, const IoContext& context);

}  // namespace dmoscope
