#pragma once
// Boundary layers: stacks of stretched quadrilaterals, wedges or hexahedra that grow from a boundary.

#include <vector>

#include "core/mesh/mesh.h"
#include "core/mesh/plane.h"

namespace dmoscope {

struct BoundaryLayers {
  std::vector<Index> elements;         // ascending
  std::vector<std::uint16_t> heights;  // of each its place in its stack: 1 is at the wall
  Index stacks = 0;
  std::uint16_t most = 0;  // layers of the highest stack
  [[nodiscard]] bool empty() const noexcept { return elements.empty(); }
};

/// A stack begins at an edge (in a volume: a face) of the boundary whose element is at least twice as wide along it as it is high. It goes
/// on from one side of an element to the opposite one, while elements are at least 1.2 times as wide as high, and not less than 0.8 times
/// as high as the one below: layers get higher from the wall on. An element is in the stack that comes first to it. Linear in their number.
[[nodiscard]] BoundaryLayers find_boundary_layers(const Mesh& mesh, const Geometry& geometry);

}  // namespace dmoscope
