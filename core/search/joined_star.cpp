#include "core/search/joined_star.h"

#include <algorithm>
#include <tuple>
#include <type_traits>
#include <utility>

#include "core/search/candidate_grid.h"

namespace dmoscope {

namespace {

/// Calls f with each corner of an element except the star's vertex.
template <class Element, class F>
void for_corners(Element& element, const F& f) {
  if constexpr (requires { element.others; }) {
    for (auto& other : element.others) f(other);
  } else if constexpr (requires { element.base; }) {
    for (auto& other : element.base) f(other);
  } else {
    f(element.b);
    f(element.c);
    if constexpr (requires { element.d; }) f(element.d);
  }
}

auto lists_in(Star<double>& star) { return std::tie(star.triangles, star.quadrilaterals); }
auto lists_in(SurfaceStar& star) { return std::tie(star.triangles, star.quadrilaterals); }
auto lists_in(VolumeStar<double>& star) { return std::tie(star.tetrahedra, star.hexahedra, star.wedges, star.pyramids, star.tips); }

/// Converts a star to another unit.
template <class S>
void rescale_star(S& star, double scale) {
  const double factor = star.scale / scale, area = factor * factor;
  const double measure = std::is_same_v<S, VolumeStar<double>> ? area * factor : area;
  const auto rescale = [&](auto& list) {
    for (auto& element : list) {
      for_corners(element, [factor](auto& corner) { corner = times(corner, factor); });
      element.reference = element.reference * measure;
    }
  };
  std::apply([&](auto&... lists) { (rescale(lists), ...); }, lists_in(star));
  star.scale = scale;
}

/// Appends a star, both in the larger unit of the two.
template <class S>
void append_star(S theirs, S& out) {
  const double scale = std::max(out.scale, theirs.scale);
  rescale_star(out, scale);
  rescale_star(theirs, scale);
  const auto append = [](const auto& from, auto& to) { to.insert(to.end(), from.begin(), from.end()); };
  std::apply([&](auto&... to) { std::apply([&](const auto&... from) { (append(from, to), ...); }, lists_in(theirs)); }, lists_in(out));
}

template <class Frame, class S>
void gather_both(const MeshView<Frame>& mesh, PositionView positions, Index vertex, Index follower, S& out) {
  gather_star(MeshStar(mesh, positions, vertex), out);
  if (follower == kNoIndex) return;
  S other;
  gather_star(MeshStar(mesh, positions, follower), other);
  append_star(std::move(other), out);
  StarBox<OffsetIn<Frame, double>> box;
  const auto add = [&box](auto& list) {
    for (auto& element : list) for_corners(element, [&box](const auto& corner) { box.add(corner); });
  };
  std::apply([&](auto&... lists) { (add(lists), ...); }, lists_in(out));
  out.box = box.size();
}

}  // namespace

void gather_star_with(const MeshView<Plane>& mesh, PositionView positions, Index vertex, Index follower, Star<double>& out) {
  gather_both(mesh, positions, vertex, follower, out);
}
void gather_star_with(const MeshView<Space>& mesh, PositionView positions, Index vertex, Index follower, VolumeStar<double>& out) {
  gather_both(mesh, positions, vertex, follower, out);
}
void gather_star_with(const MeshView<Curved>& mesh, PositionView positions, Index vertex, Index follower, SurfaceStar& out) {
  gather_star(mesh, positions, vertex, out);
  if (follower == kNoIndex) return;
  SurfaceStar other;
  gather_star(mesh, positions, follower, other);
  append_star(std::move(other), out);
}

}  // namespace dmoscope
