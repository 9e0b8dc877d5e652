#pragma once
// Interfaces that the parts of Gmsh's MSH formats share.
// https://gmsh.info/doc/texinfo/gmsh.html#Gmsh-file-formats

#include <array>
#include <cstdint>
#include <string_view>

#include "core/io/cell_table.h"
#include "core/io/format.h"

namespace dmoscope {

/// Type number in Gmsh of each CellShape; the corners come in the same order.
inline constexpr std::array<std::int64_t, kCellShapeCount> kGmshTypes{15, 1, 2, 3, 4, 5, 6, 7};
inline constexpr std::string_view kGmshPhysical = "physical group";       // role of groups
inline constexpr std::string_view kGmshEntity = "entity";                 // role of groups of cells without a physical group
inline constexpr std::string_view kGmshGeometrical = "gmsh:geometrical";  // field of the elements' entities, named as by other tools

/// Reader, see FormatHandler. Versions 2 and 4.1, ASCII and binary of either byte order. Throws InputError, Cancelled.
Mesh read_gmsh(SourceFile& source, const IoContext& context);
/// Writer, see FormatHandler. Version 2.2, ASCII, which most programs read. Throws OutputError, Cancelled.
Notes write_gmsh(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context);

}  // namespace dmoscope
