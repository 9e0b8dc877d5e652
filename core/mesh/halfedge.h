#pragma once
// OpenMesh's half-edge structure in memory, for what needs order: rings and boundary loops of a picked place, manifold checks.
// It takes about a second per million vertices to build: make it when asked for. What every load needs (boundary, components, number
// of boundary curves, odd edges) comes from edges.h; the tests compare the two.

#include <memory>
#include <vector>

#include "core/mesh/mesh.h"

namespace dmoscope {

class HalfEdges {
 public:
  /// Builds the half-edges of all planar elements. Elements that OpenMesh cannot take (non-manifold) are left out and counted.
  explicit HalfEdges(const Mesh& mesh);
  ~HalfEdges();
  HalfEdges(HalfEdges&&) noexcept;
  HalfEdges& operator=(HalfEdges&&) noexcept;
  /// Elements add_face refused; 0 for a manifold mesh.
  [[nodiscard]] Index refused_elements() const noexcept;
  /// Edge neighbours of a vertex in counter-clockwise order; for a boundary vertex from one boundary edge to the other.
  [[nodiscard]] std::vector<Index> ring(Index vertex) const;
  /// Closed boundary loops, each as its vertices in order (the mesh to the left).
  [[nodiscard]] std::vector<std::vector<Index>> boundary_loops() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dmoscope
