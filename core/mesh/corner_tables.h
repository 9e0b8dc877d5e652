#pragma once
// Corners of volume elements where three edges meet: the corner and the ends of its edges, right-handed. A pyramid's apex, where four meet,
// is covered by the corners of its base.

#include <array>
#include <cstdint>

#include "core/mesh/mesh.h"

namespace dmoscope {

using CornerTable = std::array<std::uint8_t, 4>;

inline constexpr std::array<CornerTable, 8> kHexahedronCorners{
    {{0, 1, 3, 4}, {1, 2, 0, 5}, {2, 3, 1, 6}, {3, 0, 2, 7}, {4, 7, 5, 0}, {5, 4, 6, 1}, {6, 5, 7, 2}, {7, 6, 4, 3}}};
inline constexpr std::array<CornerTable, 6> kWedgeCorners{
    {{0, 1, 2, 3}, {1, 2, 0, 4}, {2, 0, 1, 5}, {3, 5, 4, 0}, {4, 3, 5, 1}, {5, 4, 3, 2}}};
inline constexpr std::array<CornerTable, 4> kPyramidCorners{{{0, 1, 3, 4}, {1, 2, 0, 4}, {2, 3, 1, 4}, {3, 0, 2, 4}}};

/// Row `i` of the corner table of a hexahedron, wedge or pyramid.
[[nodiscard]] inline CornerTable corner_row(ElementKind kind, std::size_t i) {
  if (kind == ElementKind::Hexahedron) return kHexahedronCorners[i];
  return kind == ElementKind::Wedge ? kWedgeCorners[i] : kPyramidCorners[i];
}

}  // namespace dmoscope
