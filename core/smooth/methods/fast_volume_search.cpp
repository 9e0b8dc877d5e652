#include "core/smooth/methods/fast_volume_search.h"

namespace dmoscope {

VolumeFound VolumeStarSearch::find(const IndexedStars::Star& star, PositionView positions, Index vertex, int levels,
                                   VolumePoints& points) const {
  if (!star.fits) return {};
  const std::size_t count = star.vertices.size();
  if (points.exact.size() < count) {
    points.exact.resize(count);
    points.fast.resize(count);
  }
  const Vec3 origin = positions[vertex];
  StarBox<Vec3> box;
  for (std::size_t i = 0; i < count; ++i) {
    points.exact[i] = positions[star.vertices[i]];
    box.add(points.exact[i] - origin);
  }
  points.scale = star_scale<Space>(box.largest());
  const double inverse = 1.0 / points.scale;
  const auto narrow = [inverse](Vec3 p) {
    return Vec3Of<float>{static_cast<float>(p.x * inverse), static_cast<float>(p.y * inverse), static_cast<float>(p.z * inverse)};
  };
  for (std::size_t i = 0; i < count; ++i) points.fast[i] = narrow(points.exact[i] - origin);
  points.box = narrow(box.size());
  return kernel_.search({star.elements, points.fast.data(), points.box, parameters_.grid_points, levels, parameters_.omega});
}

}  // namespace dmoscope
