#pragma once
// Volume meshes that are one cell thick, as in 2-D cases and extruded meshes: judged and smoothed as the 2-D mesh of their front.
//
// Each cell stands between a front and a back sheet, and each vertex of one has its partner on the other. All judging and moving works on
// the mesh of the front faces, which has the vertices and elements of the file under their own numbers: element e is the front of cell e,
// and the vertices of the back belong to no element. The result has the cells again, with the back behind the front.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/progress.h"
#include "core/mesh/faces.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// Whether a mesh one cell thick is replaced by the 2-D mesh of its front. Auto: if that is possible.
enum class Thin : std::uint8_t { Off, On, Auto };
[[nodiscard]] std::string_view name(Thin choice);
/// Parses "off", "on" or "auto". Throws UsageError.
[[nodiscard]] Thin parse_thin(std::string_view word);

/// The cells behind a mesh of front faces, and the partners of its vertices.
struct ThinMesh {
  ElementTable elements;
  std::vector<std::uint8_t> flipped;
  std::vector<Group> groups;
  std::vector<std::array<Index, 2>> periodic;
  std::vector<Index> front;  // by vertex, its partner on the front; itself for a vertex of the front, or of no cell
  std::vector<Index> back;  // by vertex of the front, its partner on the back, or itself on an axis that both share; kNoIndex for any other
};

/// Replaces a mesh, as it was read, by that of its front. Returns an empty string, or why that cannot be, and then the mesh is unchanged.
/// Required are
/// - cells that are all hexahedra and wedges, each with two faces across from each other on the boundary, in a way that its
///   neighbours agree with. Faces that share an edge count as opposite on the axis of a mesh that has been turned by a few degrees;
/// - a way from front to back that changes by less than a quarter of the way along the front, so that a sound front has a sound back.
[[nodiscard]] std::string take_front(Mesh& mesh, Progress& progress);
/// The vertex itself, or the partner on the front that a vertex of the back follows.
[[nodiscard]] Index on_front(const Mesh& mesh, Index vertex);
/// Gives a mesh of front faces its cells back; any other mesh is unchanged.
[[nodiscard]] Mesh with_cells(Mesh mesh);

// Search for the front face of each cell, in a mesh one cell thick.

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
