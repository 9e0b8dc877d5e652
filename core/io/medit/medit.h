#pragma once
// Interfaces that the reader and the writer of MEDIT files share.

#include <array>
#include <string_view>

#include "core/io/cell_table.h"
#include "core/io/format.h"

namespace dmoscope {

inline constexpr std::string_view kMeditSignature = "MeshVersionFormatted";
/// A section that lists vertices, edges, triangles or quadrilaterals by their numbers, and becomes a group of that name.
struct MeditMark {
  std::string_view keyword;
  int code;  // code in binary files
  CellShape of;
};
inline constexpr std::array kMeditMarks{MeditMark{"Corners", 13, CellShape::Point},
                                        MeditMark{"Ridges", 14, CellShape::Line},
                                        MeditMark{"RequiredVertices", 15, CellShape::Point},
                                        MeditMark{"RequiredEdges", 16, CellShape::Line},
                                        MeditMark{"RequiredTriangles", 17, CellShape::Triangle},
                                        MeditMark{"RequiredQuadrilaterals", 18, CellShape::Quadrilateral}};
inline constexpr std::string_view kMeditMark = "mark";            // role of these groups
inline constexpr std::string_view kMeditReference = "reference";  // role of the groups and of the field of references
inline constexpr std::string_view kMeditField = "medit:ref";      // the vertices' references, named as by other tools

/// The mark of this name, in whatever case; null for any other.
[[nodiscard]] const MeditMark* medit_mark(std::string_view keyword) noexcept;

/// Writer, see FormatHandler::write. Elements are sorted by their kinds. Throws OutputError, Cancelled.
Notes write_medit(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context);

}  // namespace dmoscope
