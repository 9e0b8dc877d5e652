#pragma once
// OpenMesh's half-edge structure in memory, for what needs order: rings, boundary loops, manifold checks.

#include <memory>
#include <optional>
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
