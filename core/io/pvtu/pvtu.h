#pragma once
// PVTU files: they name the VTU files that hold the pieces of a mesh.
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

/// The pieces' files, in their order, as they can be opened. `bytes`: of the PVTU file `path`. Throws InputError.
[[nodiscard]] std::vector<std::filesystem::path> pvtu_pieces(std::string_view bytes, const std::filesystem::path& path);
/// The same file with other pieces, which lie beside it. Throws InputError.
[[nodiscard]] std::string pvtu_with_pieces(std::string_view bytes, const std::filesystem::path& path,
                                           const std::vector<std::string>& names);
/// "coast_3.vtu": what the piece of a PVTU file is called that is written anew.
[[nodiscard]] std::string pvtu_piece_name(const std::filesystem::path& path, std::size_t piece);
/// Is a file called so?
[[nodiscard]] bool is_pvtu_piece_name(const std::filesystem::path& path, const std::filesystem::path& file);

/// Which numbers of a piece say what its vertices and elements are in the whole mesh. Null: it has no such field. Ids are whole numbers,
/// each as often as the pieces share what it stands for.
struct PieceIds {
  const Field* vertices = nullptr;  // "GlobalNodeIds" and the like, or of the role GLOBAL_IDS
  const Field* elements = nullptr;  // likewise "GlobalCellIds"
  const Field* ghosts = nullptr;    // "vtkGhostType": elements whose first bit is set are another piece's
  [[nodiscard]] bool is_ghost(Index element) const {
    return ghosts != nullptr && (static_cast<unsigned>(ghosts->values[element]) & 1U) != 0;
  }
};
/// Does a field number vertices or elements of a whole mesh?
[[nodiscard]] bool is_id_field(const Field& field);
/// Throws InputError for ids that are no whole numbers from 0 on.
[[nodiscard]] PieceIds piece_ids(const Mesh& piece);

/// One mesh of all pieces. Vertices of one id are one, or, where a piece has no ids, those whose coordinates have the same bits; they come
/// in the order of the ids, or in that of the pieces. Elements likewise, but for ghosts; without ids they come in the order of the pieces.
/// Fields that all pieces have are kept. Throws InputError where pieces disagree on where a vertex stands. `notes`: what was left out.
[[nodiscard]] Mesh join_pieces(const std::vector<Mesh>& pieces, const std::string& file, std::vector<std::string>& notes);

/// See FormatHandler::read.
[[nodiscard]] Mesh read_pvtu(SourceFile& source, const IoContext& context);
/// See FormatHandler::write. Writes the pieces beside the file, with ids, and makes them their names; only `file` is left to be made its.
/// As many pieces as the context says, or one for each million elements.
std::vector<std::string> write_pvtu(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context);

}  // namespace dmoscope
