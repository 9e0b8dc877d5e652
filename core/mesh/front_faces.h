#pragma once
// Which face of each cell is its front, in a mesh one cell thick.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/faces.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

struct FrontFaces {
  std::vector<std::array<Index, 4>> corners;  // by cell; the normal points to the back
  std::vector<std::uint8_t> counts;           // of them: 3 or 4
  std::vector<Index> front, back;             // see ThinMesh
  std::string why_not;                        // empty: these are they
};

/// See take_front(). `faces`: of the mesh, whose elements are all volumes with their windings made one.
[[nodiscard]] FrontFaces find_front_faces(const Mesh& mesh, const FaceNeighbours& faces);

/// Whether a mesh may be one cell thick: where it is not, this often tells it without a look at the faces. Empty, or why it is not.
[[nodiscard]] std::string why_not_prismatic(const Mesh& mesh);

}  // namespace dmoscope
