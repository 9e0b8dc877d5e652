#pragma once
// The star of a vertex with each of its other vertices known once, as plain data for kernels.

#include <array>
#include <cstddef>
#include <cstdint>

namespace dmoscope {

/// At most this many elements of a kind; other stars are the plain search's.
inline constexpr std::size_t kMaxSolids = 96;

/// The kinds of elements of a star, in the order in which they stand.
enum class StarKind : std::uint8_t { Tetrahedra, Hexahedra, Wedges, Pyramids, Tips, Triangles, Quadrilaterals };
inline constexpr std::size_t kSolidKinds = 5, kStarKinds = 7;  // the first are of volumes
/// Of an element of a kind: the corners that are not the star's vertex, in the order of StarTetrahedron and so on.
inline constexpr std::array<std::uint8_t, kStarKinds> kOtherCorners{3, 7, 5, 4, 4, 2, 3};

/// The elements of a star. Plain data, for kernels.
struct IndexedStar {
  const std::uint16_t* corners = nullptr;  // element after element the other corners, by their place among the star's other vertices
  std::uint8_t counts[kStarKinds] = {};    // elements of each kind
};

}  // namespace dmoscope
