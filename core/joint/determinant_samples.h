#pragma once
// Places of an element at which the determinant of its map from the ideal element is watched: its corners, and more places between these
// for hexahedra and wedges, which can be inverted inside and not at a corner.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/mesh/mesh.h"

namespace dmoscope {

/// Derivative T of the map at a place: column c is the sum over some of the element's corners of slope[c] * the corner's position. It is 1
/// for the ideal element with edges of length 1. Slopes add up to 0.
template <int D>
struct DeterminantSample {
  using Slope = std::array<double, static_cast<std::size_t>(D)>;
  std::uint8_t count = 0;
  std::array<std::uint8_t, 8> corners{};  // the first `count`
  std::array<Slope, 8> slopes{};          // slopes of these corners
};

/// Samples at the corners; a triangle or tetrahedron has one for all. A pyramid's tip is in the corners of its base. D: the kind's
/// dimension.
template <int D>
[[nodiscard]] std::span<const DeterminantSample<D>> corner_samples(ElementKind kind);
/// Samples of a hexahedron in the middle of its edges, of its faces and of itself, of a wedge in the middle of the edges between its
/// triangles; other kinds have none.
template <int D>
[[nodiscard]] std::span<const DeterminantSample<D>> inner_samples(ElementKind kind);

}  // namespace dmoscope
