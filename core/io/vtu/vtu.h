#pragma once
// VTU and VTP files: VTK's XML UnstructuredGrid and PolyData; and its structured grids (.vts, .vtr, .vti), which are only read. ASCII,
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

/// An attribute of PointData and CellData that names the array with a role, and the role's name in VTK legacy files.
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

/// Writer of new VTU files: appended raw data of double precision, zlib, 64-bit sizes; see FormatHandler::write.
std::vector<std::string> write_vtu(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context);

/// Writer of new VTP files, encoded like those of write_vtu(). Throws OutputError for volume elements.
std::vector<std::string> write_vtp(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context);

/// VTU's word for the type that write_vtu() gives a field: its own if that holds all its values exactly, else double.
[[nodiscard]] std::string_view vtu_type_word(const Field& field);

/// Writes mesh.source again with moved coordinates, in its own encoding; all else stays byte for byte.
std::vector<std::string> patch_vtu(AtomicFile& file, const Mesh& mesh, const MovedMesh& moved, const IoContext& context);

}  // namespace dmoscope
