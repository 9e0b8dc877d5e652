#include "core/smooth/methods/star_points.h"

#include <algorithm>
#include <cmath>

#include "core/search/grid_search.h"
#include "core/search/mesh_star.h"

namespace dmoscope {

template <class Frame>
void gather_points(const Frame& frame, const IndexedStars::Star& star, PositionView positions, Index vertex, StarPoints<Frame>& points) {
  const std::size_t count = star.vertices.size();
  if (points.at.size() < count) {
    points.at.resize(count);
    points.offsets.resize(count);
  }
  const Vec3 origin = positions[vertex];
  StarBox<OffsetIn<Frame, double>> box;
  for (std::size_t i = 0; i < count; ++i) {
    points.at[i] = positions[star.vertices[i]];
    points.offsets[i] = frame.offset(points.at[i], origin);
    box.add(points.offsets[i]);
  }
  points.scale = star_scale<Frame>(box.largest());
  const double inverse = 1.0 / points.scale;
  for (std::size_t i = 0; i < count; ++i) points.offsets[i] = times(points.offsets[i], inverse);
  points.box = times(box.size(), inverse);
}
template void gather_points(const Plane&, const IndexedStars::Star&, PositionView, Index, StarPoints<Plane>&);
template void gather_points(const Space&, const IndexedStars::Star&, PositionView, Index, StarPoints<Space>&);

template <class Frame>
void fill_star(const IndexedStars::Star& star, const StarPoints<Frame>& points, StarIn<Frame, double>& out) {
  const std::uint16_t* corner = star.elements.corners;
  const auto fill = [&]<class Element>(StarKind kind, std::vector<Element>& list) {
    list.resize(star.elements.counts[static_cast<std::size_t>(kind)]);
    for (Element& element : list) {
      const auto next = [&] { return points.offsets[*corner++]; };
      if constexpr (requires { element.others; }) {
        for (Vec3& other : element.others) other = next();
      } else if constexpr (requires { element.base; }) {
        for (Vec3& other : element.base) other = next();
      } else {
        element.b = next();
        element.c = next();
        if constexpr (requires { element.d; }) element.d = next();
      }
    }
  };
  if constexpr (std::is_same_v<Frame, Plane>) {
    fill(StarKind::Triangles, out.triangles);
    fill(StarKind::Quadrilaterals, out.quadrilaterals);
  } else {
    fill(StarKind::Tetrahedra, out.tetrahedra);
    fill(StarKind::Hexahedra, out.hexahedra);
    fill(StarKind::Wedges, out.wedges);
    fill(StarKind::Pyramids, out.pyramids);
    fill(StarKind::Tips, out.tips);
  }
  out.box = points.box;
  out.scale = points.scale;
}
template void fill_star(const IndexedStars::Star&, const StarPoints<Plane>&, Star<double>&);
template void fill_star(const IndexedStars::Star&, const StarPoints<Space>&, VolumeStar<double>&);

bool has_metric(const IndexedStar& star, Metric metric) {
  const bool for_corners = formulas::with_volume_metric(metric, []<Metric M>() { return formulas::kDefinedForCorners<M>; });
  return for_corners || std::all_of(star.counts + 1, star.counts + kSolidKinds, [](std::uint8_t count) { return count == 0; });
}

double metric_of_rank(Metric metric, double rank) {
  return formulas::with_volume_metric(metric, [rank]<Metric M>() {
    if constexpr (requires { formulas::Formula<M>::of_volume_rank(rank); })
      return formulas::Formula<M>::of_volume_rank(rank);
    else
      return rank;
  });
}

}  // namespace dmoscope
