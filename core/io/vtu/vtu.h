#pragma once
// VTU and VTP files: VTK's XML UnstructuredGrid and PolyData; and its structured grids (.vts, .vtr, .vti), which are read alone. ASCII,
// base64 (inline or appended) and raw appended data, uncompressed or zlib, either byte order, sizes of 32 or 64 bits.

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/reading/io_context.h"
#include "core/io/reading/source_file.h"
#include "core/io/writing/atomic_file.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// The attribute of PointData and CellData that names the array which has a role, and the role's name in VTK legacy files.
struct VtuRole {
  const char* attribute;
  std::string_view role;
};
inline constexpr std::array kVtuRoles{VtuRole{"Scalars", "SCALARS"},
                                      VtuRole{"Vectors", "VECTORS"},
                                      VtuRole{"Normals", "NORMALS"},
                                      VtuRole{"Tensors", "TENSORS"},
                                      VtuRole{"TCoords", "TEXTURE_COORDINATES"},
                                      VtuRole{"GlobalIds", "GLOBAL_IDS"},
                                      VtuRole{"PedigreeIds", "PEDIGREE_IDS"}};

/// Reads a VTU or VTP file; see FormatHandler::read. Several pieces become one mesh, without joining points on their seams. Cells of fewer
/// dimensions than the elements are passed over as in VTK legacy files.
[[nodiscard]] Mesh read_vtu(SourceFile& source, const IoContext& context);

/// Makes a VTU file anew: appended raw data of double precision, zlib, 64-bit sizes; see FormatHandler::write.
std::vector<std::string> write_vtu(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context);

/// Makes a VTP file anew, encoded as write_vtu() does. Throws OutputError for volume elements.
std::vector<std::string> write_vtp(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context);

/// The type that write_vtu() gives a field: its own where that holds all its values exactly, else double; and VTU's word for it.
[[nodiscard]] std::string_view vtu_type_word(const Field& field);

/// Writes mesh.source again with moved coordinates, in its own encoding; all but the points stays byte for byte.
std::vector<std::string> patch_vtu(AtomicFile& file, const Mesh& mesh, const MovedMesh& moved, const IoContext& context);

}  // namespace dmoscope
