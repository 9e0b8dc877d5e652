#pragma once
// Search for a place in a mesh, beginning at a vertex near it.

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/mesh/plane.h"
#include "core/mesh/topology.h"
#include "core/reference/simplex_tree.h"

namespace dmoscope {

/// The part of an element that a place lies in, or the nearest part: a triangle (N = 3) or a tetrahedron (4), and the weights of its
/// corners, which are >= 0 and add up to 1.
template <std::size_t N>
struct MeshPlace {
  std::array<Index, N> corners{};
  std::array<double, N> weights{};
};

/// Finds places in a mesh whose elements are split into triangles (of a plane or a surface) or tetrahedra. A quadrilateral is split by its
/// shorter diagonal, a volume element such that it fits its neighbours. Mesh and topology must outlive it; threads may share it.
template <std::size_t N>
class PlaceSearch {
 public:
  /// Prepares the search. `positions`: those of the mesh, in the coordinates of the places.
  PlaceSearch(const Mesh& mesh, std::span<const Vec3> positions, const Topology& topology, const Geometry& geometry);

  /// The nearest part of the mesh. `near`: a vertex of an element; the nearer, the faster. Of several equally near parts the choice does
  /// not depend on earlier calls.
  [[nodiscard]] MeshPlace<N> at(Index near, Vec3 place) const;

 private:
  struct Found {
    Index element = kNoIndex;
    MeshPlace<N> place;
    double square;
  };
  using Part = std::array<Index, N>;
  struct Tree {
    SimplexTree<N> simplices;
    std::vector<Part> parts;
    std::vector<Index> first_of;  // by element, its first part if it has any
  };
  template <class Visit>
  void for_parts(Index element, const Visit& visit) const;
  [[nodiscard]] std::array<Vec3, N> points(const Part& part) const;
  void look_around(Index vertex, Vec3 place, Found& best) const;
  [[nodiscard]] const Tree& tree() const;

  const Mesh& mesh_;
  std::span<const Vec3> positions_;
  const Topology& topology_;
  Plane plane_;
  bool wraps_ = false;
  double rounding_ = 0.0;  // rounding of a distance, squared
  mutable std::once_flag planted_;
  mutable std::unique_ptr<Tree> tree_;
};

}  // namespace dmoscope
