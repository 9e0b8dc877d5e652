#pragma once
// PVTU files, which name the VTU files that hold the pieces of a mesh.
// Format: https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/reading/io_context.h"
#include "core/io/reading/source_file.h"
#include "core/io/writing/atomic_file.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// Paths of the pieces' files, in their order. `bytes`: content of the PVTU file `path`. Throws InputError.
[[nodiscard]] std::vector<std::filesystem::path> pvtu_pieces(std::string_view bytes, const std::filesystem::path& path);
/// The PVTU file with the names of other pieces beside it. Throws InputError.
[[nodiscard]] std::string pvtu_with_pieces(std::string_view bytes, const std::filesystem::path& path,
                                           const std::vector<std::string>& names);
/// Name for a new piece of a PVTU file: "coast_3.vtu".
[[nodiscard]] std::string pvtu_piece_name(const std::filesystem::path& path, std::size_t piece);
/// Whether a file has such a name.
[[nodiscard]] bool is_pvtu_piece_name(const std::filesystem::path& path, const std::filesystem::path& file);

/// Fields of a piece that number its vertices and elements in the whole mesh. Null: it has no such field. Ids are whole numbers, equal in
/// all pieces that share a vertex or element.
struct PieceIds {
  const Field* vertices = nullptr;  // "GlobalNodeIds" and the like, or with the role GLOBAL_IDS
  const Field* elements = nullptr;  // "GlobalCellIds" and the like, or with the role GLOBAL_IDS
  const Field* ghosts = nullptr;    // "vtkGhostType": elements whose first bit is set belong to another piece
  [[nodiscard]] bool is_ghost(Index element) const {
    return ghosts != nullptr && (static_cast<unsigned>(ghosts->values[element]) & 1U) != 0;
  }
};
/// Whether a field numbers vertices or elements of a whole mesh.
[[nodiscard]] bool is_id_field(const Field& field);
/// Finds the ids of a piece. Throws InputError for ids that are no whole numbers from 0 on.
[[nodiscard]] PieceIds piece_ids(const Mesh& piece);

/// Joins all pieces to one mesh. Vertices with the same id are one, or, for pieces without ids, those whose coordinates have the same bits;
/// they come in the order of the ids, or in that of the pieces. So do elements, without ghosts; without ids they come in the order of the
/// pieces. Fields that all pieces have are kept. Throws InputError if pieces disagree on the position of a vertex. `notes`: data that were
/// left out.
[[nodiscard]] Mesh join_pieces(const std::vector<Mesh>& pieces, const std::string& file, std::vector<std::string>& notes);

/// Writer, see FormatHandler::write. Writes the pieces beside the file, with ids, and gives them their final names; only `file` is left to
/// be committed. The context sets the number of pieces; by default there is one for each million elements.
std::vector<std::string> write_pvtu(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context);

}  // namespace dmoscope
