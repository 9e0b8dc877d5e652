#pragma once
// Boundary loops and connected parts of a planar or surface mesh, by its half-edges: names for parts that most files do not name.

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
  std::vector<Index> vertices;  // vertices in order, with the mesh to the left
  double length = 0.0;          // length in mesh units
  double area = 0.0;            // area that it encloses; of a loop that is not planar, that of its largest projection
  Index part = 0;               // number of the part that it bounds, from 0
  bool outer = false;           // whether it encloses its part, in a planar mesh
};

/// A part of the mesh: elements that are connected across edges.
struct MeshPart {
  std::vector<Index> elements;  // elements in ascending order
  Index vertices = 0;
  Index loops = 0;    // number of loops that bound it
  double area = 0.0;  // sum of the areas of its elements
};

/// Parts and loops of a mesh. Parts come in the order of their first elements; loops in the order of their parts, the outer one first, then
/// by their lowest vertices.
struct Outline {
  std::vector<MeshPart> parts;
  std::vector<BoundaryLoop> loops;
  Index left_out = 0;  // number of elements without half-edges: a third one at an edge, or one wound against its neighbours

  /// Name of a loop, numbered from 1: "loop 2", or "loop 1 (outer)" for the outer loop of a part. `loop`: its index from 0.
  [[nodiscard]] std::string name(Index loop) const;
  /// Place of a vertex on a loop, as find() returns it; none for a vertex inside. If loops touch, the first.
  struct Place {
    Index loop;
    Index at;
  };
  [[nodiscard]] std::optional<Place> find(Index vertex) const;
};

/// The outline of a mesh, measured at the file's positions or at `places`. Empty for a volume mesh. Takes about two seconds for a million
/// vertices, so call it on demand. Throws UsageError if the program was built without OpenMesh.
[[nodiscard]] Outline outline_of(const Mesh& mesh, std::span<const Vec3> places);
[[nodiscard]] Outline outline_of(const Mesh& mesh);

/// The vertices of "loop:2" or "part:1". `what`: "loop" or "part"; `number`: the text behind the colon. Throws UsageError.
[[nodiscard]] std::vector<Index> vertices_of_outline(const Mesh& mesh, std::string_view what, std::string_view number);

/// The neighbours of a vertex across edges, in order, counter-clockwise if its elements are; on the boundary from one of its edges to the
/// other. Empty for a vertex of a volume mesh, or of no element.
[[nodiscard]] std::vector<Index> ordered_ring(const Mesh& mesh, const Topology& topology, Index vertex);

}  // namespace dmoscope
