#include "core/joint/surface_sliders.h"

namespace dmoscope {

std::optional<SurfaceSlider::Stand> stand_on_surface(const Facets& facets, const SurfaceSlider::Stand& from, Vec3 normal, Vec3 way) {
  const Plane plane = tangent_plane(normal);
  const auto there = facets.walk(from.place.facet, plane, from.position, plane.project(way), kSteepest);
  if (!there) return std::nullopt;
  return SurfaceSlider::Stand{*there, facets.at(*there)};
}

void walk_on_surface(const Facets& facets, SurfaceSlider& slider) {
  constexpr int kHalvings = 8;
  slider.trial = slider.now;
  if (slider.normal == Vec3{}) slider.asked = {};
  for (int i = 0; i <= kHalvings && !(slider.asked == Vec3{}); ++i, slider.asked = 0.5 * slider.asked) {
    const auto stand = stand_on_surface(facets, slider.now, slider.normal, slider.asked);
    if (!stand) continue;
    slider.trial = *stand;
    return;
  }
  slider.asked = {};
}

}  // namespace dmoscope
