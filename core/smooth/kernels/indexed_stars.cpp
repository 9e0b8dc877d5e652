#include "core/smooth/kernels/indexed_stars.h"

#include <algorithm>

#include "core/base/memory.h"
#include "core/base/thread_pool.h"
#include "core/search/mesh_star.h"

namespace dmoscope {

namespace {

struct TurnedElement {
  StarKind kind;
  std::array<Index, 7> others;  // vertices
};

/// Element as the star of its corner `at.corner` has it.
TurnedElement turned_element(std::span<const Index> corners, Index corner, bool planar) {
  TurnedElement element{};
  if (planar) {
    element.kind = corners.size() == 3 ? StarKind::Triangles : StarKind::Quadrilaterals;
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) element.others[i] = corners[(corner + i + 1) % corners.size()];
    return element;
  }
  const auto take = [&](StarKind kind, Index (*turn)(Index, Index)) {
    element.kind = kind;
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) element.others[i] = corners[turn(corner, static_cast<Index>(i + 1))];
  };
  if (corners.size() == 4)
    take(StarKind::Tetrahedra, turned::tetrahedron);
  else if (corners.size() == 8)
    take(StarKind::Hexahedra, turned::hexahedron);
  else if (corners.size() == 6)
    take(StarKind::Wedges, turned::wedge);
  else if (corner < 4)
    take(StarKind::Pyramids, turned::pyramid);
  else
    element = {StarKind::Tips, {corners[0], corners[1], corners[2], corners[3]}};
  return element;
}

}  // namespace

void IndexedStars::Chunk::add(const InputMesh& input, Index vertex) {
  const bool planar = !input.is_volume();
  Shape shape;
  shape.first_vertex = static_cast<std::uint32_t>(vertices.size());
  shape.first_corner = static_cast<std::uint32_t>(corners.size());
  std::array<std::size_t, kStarKinds> counts{};
  for (const Incidence& at : input.topology.star(vertex))
    ++counts[static_cast<std::size_t>(turned_element(input.mesh.elements.corners(at.element), at.corner, planar).kind)];
  shape.fits = std::ranges::all_of(counts, [](std::size_t count) { return count <= kMaxSolids; });
  const auto place_of = [&](Index other) {
    const auto first = vertices.begin() + shape.first_vertex, found = std::find(first, vertices.end(), other);
    const auto place = static_cast<std::uint16_t>(found - first);
    if (found == vertices.end()) vertices.push_back(other);
    return place;
  };
  for (std::size_t kind = 0; shape.fits && kind < kStarKinds; ++kind) {
    shape.counts[kind] = static_cast<std::uint8_t>(counts[kind]);
    if (counts[kind] == 0) continue;
    for (const Incidence& at : input.topology.star(vertex)) {
      const TurnedElement element = turned_element(input.mesh.elements.corners(at.element), at.corner, planar);
      if (static_cast<std::size_t>(element.kind) != kind) continue;
      for (std::size_t i = 0; i < kOtherCorners[kind]; ++i) corners.push_back(place_of(element.others[i]));
    }
  }
  shape.vertices = static_cast<std::uint16_t>(vertices.size() - shape.first_vertex);
  shapes.push_back(shape);
}

IndexedStars::IndexedStars(const InputMesh& input, const Colouring& colouring, ThreadPool* pool)
    : chunks_((colouring.order.size() + kStarsAtOnce - 1) / kStarsAtOnce),
      visit_of_vertex_(large_vector<Index>(colouring.order.size() > 1 ? input.mesh.positions.size() : 0)) {
  for_chunks(pool, colouring.order.size(), kStarsAtOnce, [&](std::size_t first, std::size_t last) {
    Chunk made;
    made.shapes.reserve(last - first);
    for (std::size_t visit = first; visit < last; ++visit) {
      const Index vertex = colouring.order[visit];
      if (!visit_of_vertex_.empty()) visit_of_vertex_[vertex] = static_cast<Index>(visit);
      made.add(input, vertex);
    }
    made.vertices.shrink_to_fit();
    made.corners.shrink_to_fit();
    chunks_[first / kStarsAtOnce] = std::move(made);
  });
}

}  // namespace dmoscope
