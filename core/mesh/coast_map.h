#pragma once
// The invented sea of the coast sample: where land is, how fine the mesh shall be, and the outlines of the sea.

#include <vector>

#include "core/mesh/generators.h"
#include "core/mesh/raster.h"

namespace dmoscope::generators {

/// Kilometres; x to the east, y to the north. The mainland lies in the north, the open sea is bounded by an arc in the south.
class CoastMap {
 public:
  /// `finest`: edge length at the coast. Details of the coast narrower than that are left out.
  CoastMap(double finest, std::uint64_t seed, Progress& progress);

  /// Distance to the sea's outline, negative in the sea.
  [[nodiscard]] double outside(Vec2<double> p) const { return interpolate(outline_, pixel(p.x - kWest), pixel(p.y - kSouth)) * step_; }
  /// Distance from land, 0 on it.
  [[nodiscard]] double from_land(Vec2<double> p) const { return interpolate(from_land_, pixel(p.x - kWest), pixel(p.y - kSouth)) * step_; }
  /// Wanted edge length.
  [[nodiscard]] double edge_length(Vec2<double> p) const;
  /// On the open boundary's arc.
  [[nodiscard]] bool on_arc(Vec2<double> p) const;
  /// The nearest place on the arc as seen from its centre.
  [[nodiscard]] static Vec2<double> to_arc(Vec2<double> p);
  /// Closed outlines with the sea to the left, the longest first.
  [[nodiscard]] std::vector<std::vector<Vec2<double>>> outlines() const;
  /// How many vertices a mesh of this sea has when its finest edge is `finest`, roughly.
  [[nodiscard]] double estimated_vertices(double finest) const;
  [[nodiscard]] double finest() const { return finest_; }

  static constexpr double kWest = -72, kEast = 72, kSouth = -50, kNorth = 46;

 private:
  [[nodiscard]] static double edge_length(double from_land, double finest);
  [[nodiscard]] double pixel(double kilometres) const { return kilometres / step_; }
  double finest_;
  double step_;  // edge of a pixel
  Distances outline_;
  Distances from_land_;
};

}  // namespace dmoscope::generators
