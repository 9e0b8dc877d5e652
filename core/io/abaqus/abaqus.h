#pragma once
// Interfaces that the parts of Abaqus' input format (.inp), which CalculiX reads as well, share.
// https://docs.software.vt.edu/abaqusv2024/English/ (Keywords; Elements: node ordering and face numbering)

#include <optional>
#include <string_view>

#include "core/io/cell_table.h"
#include "core/io/format.h"

namespace dmoscope {

inline constexpr std::size_t kAbaqusNumber = 20;  // greatest number of characters of a real number; CalculiX cuts longer ones
inline constexpr std::string_view kAbaqusNodeSet = "node set", kAbaqusElementSet = "element set", kAbaqusSurface = "surface";

/// Meaning of an element type's name ("C3D8R", "S4"). With neither a shape nor a higher order the type is no element of a mesh.
struct AbaqusType {
  std::optional<CellShape> shape;
  bool higher_order = false;
};
[[nodiscard]] AbaqusType abaqus_type(std::string_view name) noexcept;

/// Reader, see FormatHandler. Files of one part (or none) are read. Throws InputError, Cancelled.
Mesh read_abaqus(SourceFile& source, const IoContext& context);
/// Writer, see FormatHandler: nodes, elements, sets and surfaces; no materials or steps. Throws OutputError, Cancelled.
Notes write_abaqus(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context);

}  // namespace dmoscope
