#pragma once
// Search for the front face of each cell, in a mesh one cell thick.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/faces.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

struct FrontFaces {
  std::vector<std::array<Index, 4>> corners;  // front face of each cell; the normal points to the back
  std::vector<std::uint8_t> counts;           // number of corners of each front face: 3 or 4
  std::vector<Index> front, back;             // partners of each vertex, see ThinMesh
  std::string why_not;                        // reason why there is no front; empty: it was found
};

/// Finds the front face of each cell, see take_front(). `faces`: those of `mesh`, whose elements are all volume elements of consistent
/// winding.
[[nodiscard]] FrontFaces find_front_faces(const Mesh& mesh, const FaceNeighbours& faces);

/// Cheap first test for a mesh one cell thick, which often fails without a look at the faces. Empty, or why it is not one.
[[nodiscard]] std::string why_not_prismatic(const Mesh& mesh);

}  // namespace dmoscope
