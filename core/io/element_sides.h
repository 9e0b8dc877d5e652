#pragma once
// Sides of elements: the faces of volume elements, the edges of planar ones. Several formats name boundaries by them.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/mesh/mesh.h"

namespace dmoscope {

struct ElementSide {
  Index element;
  Index side;  // index into faces_of(kind) for a volume element; for a planar one the edge from this corner to the next
};

/// Number of faces of a volume element, or of edges of a planar one.
[[nodiscard]] Index side_count(ElementKind kind) noexcept;
/// The vertices of a side: those of a face in faces_of()'s order (outward), those of an edge in the element's winding. The rest is
/// kNoIndex.
[[nodiscard]] std::array<Index, 4> vertices_of_side(const ElementTable& elements, ElementSide side) noexcept;

/// The side that each face of a group is; if two elements share it, the one whose outward winding is the face's, else the first. None for
/// faces that are no element's side.
[[nodiscard]] std::vector<std::optional<ElementSide>> sides_of_faces(const Mesh& mesh, const ElementTable& faces);
/// The side that each edge, given by two vertices, is in a mesh of planar elements. None for edges that are no element's side.
[[nodiscard]] std::vector<std::optional<ElementSide>> sides_of_edges(const Mesh& mesh, std::span<const Index> edges);

}  // namespace dmoscope
