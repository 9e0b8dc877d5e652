#pragma once
// Star of a vertex with each of its other vertices known once, as plain data for kernels.

#include <array>
#include <cstddef>
#include <cstdint>

namespace dmoscope {

/// Limit for the elements of a kind; the plain search takes other stars.
inline constexpr std::size_t kMaxSolids = 96;

/// Kinds of elements of a star, in their order.
enum class StarKind : std::uint8_t { Tetrahedra, Hexahedra, Wedges, Pyramids, Tips, Triangles, Quadrilaterals };
inline constexpr std::size_t kSolidKinds = 5, kStarKinds = 7;  // the first are for volumes
/// Number of an element's corners, by kind, that are not the star's vertex, in the order of StarTetrahedron and so on.
inline constexpr std::array<std::uint8_t, kStarKinds> kOtherCorners{3, 7, 5, 4, 4, 2, 3};

/// Elements of a star. Plain data, for kernels.
struct IndexedStar {
  const std::uint16_t* corners = nullptr;  // the other corners, element after element, by their number among the star's other vertices
  std::uint8_t counts[kStarKinds] = {};    // number of elements of each kind
};

}  // namespace dmoscope
