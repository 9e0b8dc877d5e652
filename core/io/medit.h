#pragma once
// What the reader and the writer of MEDIT files share.

#include <array>
#include <string_view>

#include "core/io/format.h"

namespace dmoscope {

inline constexpr std::string_view kMeditSignature = "MeshVersionFormatted";
/// Sections that list vertices or edges; each becomes a group named so.
inline constexpr std::array<std::string_view, 4> kMeditMarks{"Corners", "RequiredVertices", "Ridges", "RequiredEdges"};
inline constexpr std::string_view kMeditMark = "mark";            // the role of these groups
inline constexpr std::string_view kMeditReference = "reference";  // the role of groups and the field of references
inline constexpr std::string_view kMeditField = "medit:ref";      // the vertices' references, by the name that other tools use

/// Does this one of kMeditMarks list edges?
[[nodiscard]] bool is_medit_edge_mark(std::string_view keyword) noexcept;

/// See FormatHandler::write. Elements come sorted by their kinds. Throws OutputError, Cancelled.
Notes write_medit(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context);

}  // namespace dmoscope
