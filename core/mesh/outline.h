#pragma once
// The boundary loops and connected parts of a planar or surface mesh, by its half-edges: names for what most files name nothing of.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/mesh/topology.h"

namespace dmoscope {

/// A closed curve of the boundary.
struct BoundaryLoop {
  std::vector<Index> vertices;  // in order, with the mesh to the left
  double length = 0.0;          // mesh units
  double area = 0.0;            // that it encloses; of a loop that is not planar: of its shadow where that is largest
  Index part = 0;               // that it bounds, from 0
  bool outer = false;           // of a planar mesh: the part lies inside of it
};

/// Elements that are connected across edges.
struct MeshPart {
  std::vector<Index> elements;  // ascending
  Index vertices = 0;
  Index loops = 0;    // that bound it
  double area = 0.0;  // sum of the areas of its elements
};

/// Parts come in the order of their first elements; loops in that of their parts, the outer one first, then as their lowest vertices come.
struct Outline {
  std::vector<MeshPart> parts;
  std::vector<BoundaryLoop> loops;
  Index left_out = 0;  // elements that no half-edges can have: a third one at an edge, or one wound against its neighbours

  /// "loop 2", of the outer loop of a part "loop 1 (outer)"; `loop` from 0.
  [[nodiscard]] std::string name(Index loop) const;
  /// The loop that a vertex is on, and where on it; none for a vertex inside. Where loops touch, the first.
  struct Place {
    Index loop;
    Index at;
  };
  [[nodiscard]] std::optional<Place> find(Index vertex) const;
};

/// Measured where the file has the vertices, or at `places`. Empty for a volume mesh. Takes about two seconds for a million vertices: make
/// it when asked for. Throws UsageError where the program was built without OpenMesh.
[[nodiscard]] Outline outline_of(const Mesh& mesh, std::span<const Vec3> places);
[[nodiscard]] Outline outline_of(const Mesh& mesh);

/// The vertices of "loop:2" or "part:1", without what stands before the colon; `what`: "loop" or "part". Throws UsageError.
[[nodiscard]] std::vector<Index> vertices_of_outline(const Mesh& mesh, std::string_view what, std::string_view number);

/// The neighbours of a vertex across edges, in order, counter-clockwise where its elements are; on the boundary from one of its edges to
/// the other. Empty for a vertex of a volume mesh, or of no element.
[[nodiscard]] std::vector<Index> ordered_ring(const Mesh& mesh, const Topology& topology, Index vertex);

}  // namespace dmoscope
