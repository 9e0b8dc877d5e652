#pragma once
// OpenMesh's half-edge structure in memory, for what needs order: rings, boundary loops and the parts that they bound (see outline.h).
// It takes about a second per million vertices to build: make it when asked for. What every load needs (boundary, components, number
// of boundary curves, odd edges) comes from edges.h; the tests compare the two.

#include <memory>
#include <vector>

#include "core/mesh/mesh.h"

namespace dmoscope {

class HalfEdges {
 public:
  /// Builds the half-edges of all planar elements; an element with a corner twice is one with a corner less. Elements that OpenMesh cannot
  /// take (non-manifold) are left out and counted. Throws UsageError where the program was built without OpenMesh.
  explicit HalfEdges(const Mesh& mesh);
  ~HalfEdges();
  HalfEdges(HalfEdges&&) noexcept;
  HalfEdges& operator=(HalfEdges&&) noexcept;
  /// Elements add_face refused; 0 for a manifold mesh.
  [[nodiscard]] Index refused_elements() const noexcept;
  /// Edge neighbours of a vertex in counter-clockwise order; for a boundary vertex from one boundary edge to the other.
  [[nodiscard]] std::vector<Index> ring(Index vertex) const;
  struct Loop {
    std::vector<Index> vertices;  // in order, the mesh to the left
    Index element;                // one of those along it
  };
  /// Closed boundary loops.
  [[nodiscard]] std::vector<Loop> boundary_loops() const;
  /// By element: the set of elements connected across edges that it belongs to, numbered in the order of their first elements; kNoIndex of
  /// elements that were left out.
  [[nodiscard]] std::vector<Index> parts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dmoscope
