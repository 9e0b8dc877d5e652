#pragma once
// Binary pictures of a region on square pixels: distances, opening and closing, outlines.

#include <cstdint>
#include <vector>

#include "core/base/vec.h"

namespace dmoscope {

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

}  // namespace dmoscope
