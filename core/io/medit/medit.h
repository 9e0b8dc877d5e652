#pragma once
// What the reader and the writer of MEDIT files share.

#include <array>
#include <string_view>

#include "core/io/cell_table.h"
#include "core/io/format.h"

namespace dmoscope {

inline constexpr std::string_view kMeditSignature = "MeshVersionFormatted";
/// A section that lists vertices, edges, triangles or quadrilaterals by their numbers, and becomes a group named so.
struct MeditMark {
  std::string_view keyword;
  int code;  // in binary files
  CellShape of;
};
inline constexpr std::array kMeditMarks{MeditMark{"Corners", 13, CellShape::Point},
                                        MeditMark{"Ridges", 14, CellShape::Line},
                                        MeditMark{"RequiredVertices", 15, CellShape::Point},
                                        MeditMark{"RequiredEdges", 16, CellShape::Line},
                                        MeditMark{"RequiredTriangles", 17, CellShape::Triangle},
                                        MeditMark{"RequiredQuadrilaterals", 18, CellShape::Quadrilateral}};
inline constexpr std::string_view kMeditMark = "mark";            // the role of these groups
inline constexpr std::string_view kMeditReference = "reference";  // the role of groups and the field of references
inline constexpr std::string_view kMeditField = "medit:ref";      // the vertices' references, by the name that other tools use

/// The one of this name, in whatever case; null for any other.
[[nodiscard]] const MeditMark* medit_mark(std::string_view keyword) noexcept;

/// See FormatHandler::write. Elements come sorted by their kinds. Throws OutputError, Cancelled.
Notes write_medit(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context);

}  // namespace dmoscope
