#pragma once
// OpenMesh's half-edge structure in memory, for whatever needs order: rings, boundary loops and the parts that they bound (see outline.h).
// It takes about a second per million vertices to build, so it is made on demand. The boundary, components, boundary curves and odd edges
// that every load needs come from edges.h; the tests compare the two.

#include <memory>
#include <vector>

#include "core/mesh/mesh.h"

namespace dmoscope {

class HalfEdges {
 public:
  /// Builds the half-edges of all planar elements, without repeated corners. Elements that OpenMesh cannot take (non-manifold) are left out
  /// and counted. Throws UsageError if the program was built without OpenMesh.
  explicit HalfEdges(const Mesh& mesh);
  ~HalfEdges();
  HalfEdges(HalfEdges&&) noexcept;
  HalfEdges& operator=(HalfEdges&&) noexcept;
  /// Number of elements that OpenMesh refused; 0 for a manifold mesh.
  [[nodiscard]] Index refused_elements() const noexcept;
  /// Edge neighbours of a vertex in counter-clockwise order; those of a boundary vertex from one boundary edge to the other.
  [[nodiscard]] std::vector<Index> ring(Index vertex) const;
  struct Loop {
    std::vector<Index> vertices;  // vertices in order, with the mesh to the left
    Index element;                // one of the elements along the loop
  };
  /// Closed boundary loops.
  [[nodiscard]] std::vector<Loop> boundary_loops() const;
  /// Edge-connected component of each element, numbered in the order of first elements; kNoIndex for elements that were left out.
  [[nodiscard]] std::vector<Index> parts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dmoscope
