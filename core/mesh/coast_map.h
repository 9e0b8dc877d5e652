#pragma once
// The invented sea of the coast sample: where land is, how fine the mesh shall be, and the outlines of the sea.

#include <vector>

#include "core/mesh/generators.h"
#include "core/mesh/raster.h"

namespace dmoscope::generators {

/// A map in kilometres, x to the east, y to the north. The mainland lies in the north, an arc in the south bounds the open sea.
class CoastMap {
 public:
  /// Draws the sea. `finest`: edge length at the coast, in kilometres; narrower details of the coast are left out.
  CoastMap(double finest, std::uint64_t seed, Progress& progress);

  /// Distance to the sea's outline in kilometres, negative in the sea.
  [[nodiscard]] double outside(Vec2<double> p) const { return interpolate(outline_, pixel(p.x - kWest), pixel(p.y - kSouth)) * step_; }
  /// Distance from land in kilometres, 0 on it.
  [[nodiscard]] double from_land(Vec2<double> p) const { return interpolate(from_land_, pixel(p.x - kWest), pixel(p.y - kSouth)) * step_; }
  /// Wanted edge length at a place, in kilometres.
  [[nodiscard]] double edge_length(Vec2<double> p) const;
  /// Whether a place lies on the open boundary's arc.
  [[nodiscard]] bool on_arc(Vec2<double> p) const;
  /// The nearest place on the arc as seen from its centre.
  [[nodiscard]] static Vec2<double> to_arc(Vec2<double> p);
  /// Closed outlines of the sea, which lies to their left; the longest first.
  [[nodiscard]] std::vector<std::vector<Vec2<double>>> outlines() const;
  /// Estimated number of vertices of a mesh of this sea whose finest edge is `finest`.
  [[nodiscard]] double estimated_vertices(double finest) const;
  [[nodiscard]] double finest() const { return finest_; }

  static constexpr double kWest = -72, kEast = 72, kSouth = -50, kNorth = 46;

 private:
  [[nodiscard]] static double edge_length(double from_land, double finest);
  [[nodiscard]] double pixel(double kilometres) const { return kilometres / step_; }
  double finest_;
  double step_;  // edge of a pixel, in kilometres
  Distances outline_;
  Distances from_land_;
};

}  // namespace dmoscope::generators
