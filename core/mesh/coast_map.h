#pragma once
// The invented sea of the coast sample: where land is, how fine the mesh shall be, and the outlines of the sea.

#include <cstdint>
#include <vector>

#include "core/base/vec.h"
#include "core/mesh/generators.h"

namespace dmoscope::generators {

// Binary pictures of a region on square pixels: distances, opening and closing, outlines.

/// Values of pixels, row after row; pixel (i, j) has its centre at (i, j).
template <class T>
struct Raster {
  Index width = 0;
  Index height = 0;
  std::vector<T> values;
  Raster(Index w, Index h, T value) : width(w), height(h), values(std::size_t{w} * h, value) {}
  [[nodiscard]] T& at(Index i, Index j) { return values[std::size_t{j} * width + i]; }
  [[nodiscard]] const T& at(Index i, Index j) const { return values[std::size_t{j} * width + i]; }
};
using Mask = Raster<std::uint8_t>;
using Distances = Raster<double>;

/// Exact Euclidean distance of every pixel to the nearest set one, in pixels (Felzenszwalb, Huttenlocher 2012). Large if none is set.
[[nodiscard]] Distances distance_to(const Mask& mask);
/// Fills gaps between set pixels that are narrower than twice `radius`.
[[nodiscard]] Mask closed(const Mask& mask, double radius);
/// Removes parts of the set pixels that are narrower than twice `radius`.
[[nodiscard]] Mask opened(const Mask& mask, double radius);
/// The set pixels that are connected with (i, j) across pixel edges.
[[nodiscard]] Mask connected(const Mask& mask, Index i, Index j);
/// Distance to the rim of the set pixels, negative inside, smoothed a little.
[[nodiscard]] Distances signed_distance(const Mask& mask);
/// Bilinear interpolation; a place outside of the raster has the value of the nearest place on its rim.
[[nodiscard]] double interpolate(const Distances& field, double x, double y);
/// Closed curves along which the field is 0, with the negative side to the left (marching squares). The raster's rim must be positive.
[[nodiscard]] std::vector<std::vector<Vec2<double>>> zero_curves(const Distances& field);

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
