#pragma once
// Boundary layers: stacks of stretched quadrilaterals, of pairs of triangles, of wedges or hexahedra that grow from a boundary.

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/mesh/plane.h"

namespace dmoscope {

struct BoundaryLayers {
  std::vector<Index> elements;           // ascending
  std::vector<std::uint16_t> heights;    // place of each in its stack: 1 is at the wall
  std::vector<std::uint8_t> bases;       // side that each stands on: an edge, from corner i to i + 1, or a face, see faces_of()
  std::vector<std::uint8_t> pronounced;  // for each, whether its stack is pronounced
  Index stacks = 0;
  std::uint16_t most = 0;  // number of layers of the highest stack
  [[nodiscard]] bool empty() const noexcept { return elements.empty(); }
};

/// Finds stacks. A stack begins at an edge (in a volume: a face) of the boundary whose element is at least twice as wide along it as it is
/// high. It goes on from one side of an element to the opposite one, while elements are at least 1.2 times as wide as high, and not less
/// than 0.8 times as high as the one below: layers get higher from the wall on. Two triangles count as the quadrilateral that the longer
/// side of the first one cuts into them, in stacks of at least 3 layers. An element is in the stack that comes first to it. Takes time
/// linear in the number of elements. A stack is pronounced, as far as each layer is at least 0.95 and at most 2.5 times as high as the one
/// beneath, if it has at least 3 layers, begins with an element 4 times as wide as high, and ends with one 1.5 times as high as that: as
/// meshes have them that resolve a boundary layer at a wall. No stack is pronounced in a mesh where over 15 % of the elements of stacks
/// that begin so flat stand at less than 30 degrees on the wall: its grid is distorted.
[[nodiscard]] BoundaryLayers find_boundary_layers(const Mesh& mesh, const Geometry& geometry);
/// Returns whether there is an element that a pronounced stack could have. Much faster than find_boundary_layers().
[[nodiscard]] bool may_have_layers(const Mesh& mesh, const Geometry& geometry);

/// Height of an element of a stack on one of its sides: the mean of the edges away from it, for a triangle the shorter one, in mesh units.
[[nodiscard]] double height_on(const Mesh& mesh, const Geometry& geometry, std::span<const Vec3> positions, Index element, Index base);

}  // namespace dmoscope
