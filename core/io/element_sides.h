#pragma once
// Sides of elements: the faces of volume elements, the edges of planar ones. Several formats name boundaries by these.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/mesh/mesh.h"

namespace dmoscope {

struct ElementSide {
  Index element;
  Index side;  // into faces_of(kind) of a volume element; of a planar one the edge from this corner to the next
};

/// Faces of a volume element, edges of a planar one.
[[nodiscard]] Index side_count(ElementKind kind) noexcept;
/// The vertices of a side: of a face as faces_of() has them (outward), of an edge in the element's winding. The rest is kNoIndex.
[[nodiscard]] std::array<Index, 4> vertices_of_side(const ElementTable& elements, ElementSide side) noexcept;

/// The side that each face (of a group of faces) is; where two elements share it, the one whose outward winding is the face's, else the
/// first. Nothing for what is no element's side.
[[nodiscard]] std::vector<std::optional<ElementSide>> sides_of_faces(const Mesh& mesh, const ElementTable& faces);
/// The same for edges, two vertices each, of a mesh of planar elements.
[[nodiscard]] std::vector<std::optional<ElementSide>> sides_of_edges(const Mesh& mesh, std::span<const Index> edges);

}  // namespace dmoscope
