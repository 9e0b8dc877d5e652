#include "core/transfer/mesh_place.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/mesh/faces.h"

namespace dmoscope {
namespace {

constexpr double kRoundings = 64.0;  // rounding of a distance, in roundings of the largest coordinate

double square_length(Vec3 v) { return dot(v, v); }

}  // namespace

template <std::size_t N>
PlaceSearch<N>::PlaceSearch(const Mesh& mesh, std::span<const Vec3> positions, const Topology& topology, const Geometry& geometry)
    : mesh_(mesh),
      positions_(positions),
      topology_(topology),
      plane_(geometry.plane),
      wraps_(geometry.shape == Shape::Planar && geometry.plane.period > 0.0) {
  double largest = 0.0;
  for (const Vec3 p : positions) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  rounding_ = std::pow(kRoundings * std::numeric_limits<double>::epsilon() * largest, 2);
}

/// The corners of a part, on a mesh that wraps unwrapped from the first of them.
template <std::size_t N>
std::array<Vec3, N> PlaceSearch<N>::points(const Part& part) const {
  std::array<Vec3, N> points;
  for (std::size_t k = 0; k < N; ++k) {
    points[k] = positions_[part[k]];
    if (wraps_ && k > 0) points[k] = points[0] + plane_.difference(points[k], points[0]);
  }
  return points;
}

/// Splits a volume element from its corner of the lowest number to the faces without that corner, each of which is split from its own such
/// corner. So the elements on both sides of a face split it equally.
template <std::size_t N>
template <class Visit>
void PlaceSearch<N>::for_parts(Index element, const Visit& visit) const {
  const auto c = mesh_.elements.corners(element);
  if constexpr (N == 3) {
    if (c.size() == 3) return visit(Part{c[0], c[1], c[2]});
    const Vec3 a = positions_[c[0]], b = positions_[c[1]];
    const Vec3 ac = wraps_ ? plane_.difference(positions_[c[2]], a) : positions_[c[2]] - a;
    const Vec3 bd = wraps_ ? plane_.difference(positions_[c[3]], b) : positions_[c[3]] - b;
    const std::size_t first = square_length(ac) <= square_length(bd) ? 0 : 1;
    visit(Part{c[first], c[first + 1], c[first + 2]});
    visit(Part{c[first], c[first + 2], c[(first + 3) % 4]});
  } else {
    const Index apex = *std::ranges::min_element(c);
    for (const LocalFace& face : faces_of(mesh_.elements.kind(element))) {
      std::array<Index, 4> on{};
      std::size_t lowest = 0;
      for (std::size_t k = 0; k < face.count; ++k) {
        on[k] = c[face.corners[k]];
        if (on[k] < on[lowest]) lowest = k;
      }
      if (on[lowest] == apex) continue;
      const auto at = [&](std::size_t k) { return on[(lowest + k) % face.count]; };
      visit(Part{apex, at(0), at(1), at(2)});
      if (face.count == 4) visit(Part{apex, at(0), at(2), at(3)});
    }
  }
}

template <std::size_t N>
void PlaceSearch<N>::look_around(Index vertex, Vec3 place, Found& best) const {
  for (const Incidence& incidence : topology_.star(vertex))
    for_parts(incidence.element, [&](const Part& part) {
      const std::array<Vec3, N> corners = points(part);
      const Vec3 p = wraps_ ? corners[0] + plane_.difference(place, corners[0]) : place;
      const NearestIn<N> nearest = nearest_point(corners, p);
      if (nearest.square < best.square) best = {incidence.element, {part, nearest.weights}, nearest.square};
    });
}

template <std::size_t N>
const typename PlaceSearch<N>::Tree& PlaceSearch<N>::tree() const {
  std::call_once(planted_, [this] {
    auto tree = std::make_unique<Tree>();
    std::vector<std::array<Vec3, N>> simplices;
    for (Index e = 0; e < mesh_.elements.size(); ++e) {
      tree->first_of.push_back(static_cast<Index>(tree->parts.size()));
      for_parts(e, [&](const Part& part) {
        tree->parts.push_back(part);
        simplices.push_back(points(part));
      });
    }
    const std::vector<Index> one_patch(simplices.size(), 0);
    tree->simplices = SimplexTree<N>(std::move(simplices), one_patch);
    tree_ = std::move(tree);
  });
  return *tree_;
}

/// Walks from element to element as long as that leads nearer, which mostly ends in the element that has the place. Otherwise a distant
/// part of the mesh may be nearer, which the tree finds.
template <std::size_t N>
MeshPlace<N> PlaceSearch<N>::at(Index near, Vec3 place) const {
  Found best{kNoIndex, {}, std::numeric_limits<double>::infinity()};
  look_around(near, place, best);
  for (Index from = kNoIndex; best.square > rounding_ && best.element != from;) {
    from = best.element;
    for (const Index corner : mesh_.elements.corners(from)) look_around(corner, place, best);
  }
  if (best.square <= rounding_) return best.place;
  const Tree& all = tree();
  for (const double round : {0.0, plane_.period, -plane_.period}) {
    if (round != 0.0 && !wraps_) break;
    const auto nearest = all.simplices.nearest(place + Vec3{round, 0.0, 0.0}, best.element == kNoIndex ? 0 : all.first_of[best.element]);
    if (nearest.point.square < best.square)
      best = {best.element, {all.parts[nearest.triangle], nearest.point.weights}, nearest.point.square};
  }
  return best.place;
}

template class PlaceSearch<3>;
template class PlaceSearch<4>;

}  // namespace dmoscope
