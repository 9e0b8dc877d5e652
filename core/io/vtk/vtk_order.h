#pragma once
// Order of an element's corners in VTK's formats and those that use its numbering (SU2), compared with ours. It differs only for wedges: by
// VTK's definition the triangle (0, 1, 2) looks away from (3, 4, 5), with Gmsh, MEDIT and here it looks towards it.
// https://vtk.org/doc/nightly/html/classvtkWedge.html

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "core/io/format.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// Converts from VTK's order to ours, or back: its own inverse. `c`: the info(kind).corners corners.
constexpr void exchange_vtk_order(ElementKind kind, Index* c) noexcept {
  if (kind != ElementKind::Wedge) return;
  std::swap(c[1], c[2]);
  std::swap(c[4], c[5]);
}

/// Corners by file_corners(), in VTK's order.
[[nodiscard]] inline FileCorners vtk_corners(const Mesh& mesh, std::size_t element) {
  FileCorners corners = file_corners(mesh, element);
  exchange_vtk_order(mesh.elements.kind(static_cast<Index>(element)), corners.at.data());
  return corners;
}

}  // namespace dmoscope
