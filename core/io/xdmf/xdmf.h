#pragma once
// XDMF files (.xdmf, .xmf) with their numbers in the XML.
// https://www.xdmf.org/index.php/XDMF_Model_and_Format

#include <array>
#include <cstdint>
#include <string_view>

#include "core/io/array_patch.h"
#include "core/io/cell_table.h"
#include "core/io/format.h"
#include "core/io/xdmf/xdmf_document.h"

namespace dmoscope {

/// Number of each CellShape in a mixed topology of XDMF, and its name for a topology. The format does not define the winding of volume
/// elements: it is taken from the file, as most programs do.
inline constexpr std::array<std::int64_t, kCellShapeCount> kXdmfTypes{1, 2, 4, 5, 6, 9, 8, 7};
inline constexpr std::array<std::string_view, kCellShapeCount> kXdmfNames{"Polyvertex",  "Polyline",   "Triangle", "Quadrilateral",
                                                                          "Tetrahedron", "Hexahedron", "Wedge",    "Pyramid"};

/// Reader, see FormatHandler. One uniform grid, unstructured, of first order. Throws InputError, Cancelled.
Mesh read_xdmf(SourceFile& source, const IoContext& context);
/// Writer, see FormatHandler. Throws OutputError, Cancelled.
Notes write_xdmf(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context);

/// Patcher, see FormatHandler. An HDF5 file with the numbers is written beside the XML: under its own name or, if the XML gets another name
/// than it was read with, under that one with .h5. Throws OutputError, Cancelled.
Notes patch_xdmf(AtomicFile& file, const Mesh& mesh, const MovedMesh& moved, const IoContext& context);

/// Name of the file with the numbers for an XML of this name that does not hold them.
[[nodiscard]] std::string numbers_beside(const std::filesystem::path& xml);

/// Reads the points of a DataItem whose numbers are in an HDF5 file into `positions`. Throws InputError.
[[nodiscard]] CoordinateArrays read_xdmf_points(const XdmfDocument& document, pugi::xml_node item, bool plane,
                                                std::vector<Vec3>& positions);

}  // namespace dmoscope
