#pragma once
// VTK legacy files, versions 1.0 to 5.1, ASCII and BINARY: POLYDATA, UNSTRUCTURED_GRID, and structured grids,
// whose cells become quadrilaterals or hexahedra.
// Format: "The VTK User's Guide", VTK File Formats; https://docs.vtk.org/en/latest/vtk_file_formats/vtk_legacy_file_format.html

#include <span>
#include <string>
#include <vector>

#include "core/io/reading/io_context.h"
#include "core/io/reading/source_file.h"
#include "core/io/writing/atomic_file.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// Reader, see FormatHandler::read. Cells of fewer dimensions than the elements (vertices, lines, the faces of a volume mesh) are skipped
/// with a note, and their rows of cell data with them; writing the same file again keeps both.
[[nodiscard]] Mesh read_vtk(SourceFile& source, const IoContext& context);

/// Writer of new files: UNSTRUCTURED_GRID, ASCII, version 3.0; see FormatHandler::write.
std::vector<std::string> write_vtk(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context);

}  // namespace dmoscope
