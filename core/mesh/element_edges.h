#pragma once
// Edges of one element.

#include "core/mesh/faces.h"

namespace dmoscope {

/// Calls visit(a, b) once for every edge of an element of this kind, with its own corners (0-based).
template <class Visit>
void for_edges(ElementKind kind, Visit&& visit) {
  const auto faces = faces_of(kind);
  for (const LocalFace& face : faces)
    for (Index i = 0; i < face.count; ++i) {
      const Index a = face.corners[i], b = face.corners[(i + 1) % face.count];
      if (faces.size() == 1 || a < b) visit(a, b);  // two faces of a solid share an edge, in opposite directions
    }
}

/// Calls visit(a, b) once for every edge of an element, with its vertices.
template <class Visit>
void for_edges(const ElementTable& elements, Index element, Visit&& visit) {
  const auto corners = elements.corners(element);
  for_edges(elements.kind(element), [&](Index a, Index b) { visit(corners[a], corners[b]); });
}

}  // namespace dmoscope
