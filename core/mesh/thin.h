#pragma once
// Volume meshes that are one cell thick, as 2-D cases and extruded meshes have them: judged and smoothed as the 2-D mesh of their front.
//
// Each cell stands between a front and a back sheet, and each vertex of one has its partner on the other. All that judges and moves works
// on the mesh of the front faces, which has the vertices and elements of the file under their own numbers: element e is the front of cell
// e, and the vertices of the back belong to no element. What is written has the cells again, with the back behind the front.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/progress.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// Whether a mesh one cell thick is taken for the 2-D mesh that it is. Auto: where it can be.
enum class Thin : std::uint8_t { Off, On, Auto };
[[nodiscard]] std::string_view name(Thin choice);
/// Throws UsageError.
[[nodiscard]] Thin parse_thin(std::string_view word);

/// What a mesh of front faces has beside them: the cells, and who stands behind whom.
struct ThinMesh {
  ElementTable elements;
  std::vector<std::uint8_t> flipped;
  std::vector<Group> groups;
  std::vector<std::array<Index, 2>> periodic;
  std::vector<Index> front;  // by vertex: its partner of the front; itself of a vertex of the front, or of no cell
  std::vector<Index> back;   // by vertex of the front: its partner, itself on an axis that both have in common; kNoIndex of any other
};

/// Takes the mesh, as it was read, for that of its front. Empty: done; else why that cannot be, and the mesh is as it was. It can
/// - where all cells are hexahedra and wedges, and each has two faces across from each other on the boundary, in one way that its
///   neighbours agree with. Faces that share an edge are such on the axis of a mesh that has been turned by a few degrees;
/// - where the way from front to back changes by less than a quarter of the way along the front, so that a sound front has a sound back.
[[nodiscard]] std::string take_front(Mesh& mesh, Progress& progress);
/// The vertex; of one of the back its partner of the front, which it follows.
[[nodiscard]] Index on_front(const Mesh& mesh, Index vertex);
/// A mesh of front faces with its cells in their place; any other as it is.
[[nodiscard]] Mesh with_cells(Mesh mesh);

}  // namespace dmoscope
