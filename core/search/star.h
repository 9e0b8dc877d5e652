#pragma once
// The star of one vertex as the search sees it: offsets from the vertex in the mesh's plane, scaled by a power of two.

#include <cstddef>
#include <span>
#include <vector>

#include "core/base/anywhere.h"
#include "core/base/vec.h"

namespace dmoscope {

/// An incident triangle: its other two corners in the element's order, and its reference measure for untangling.
template <class Real>
struct StarTriangle {
  Vec2<Real> b, c;
  Real reference;
};
/// An incident quadrilateral: its other three corners in the element's order, and its reference measure.
template <class Real>
struct StarQuadrilateral {
  Vec2<Real> b, c, d;
  Real reference;
};

/// Everything is in units of `scale` (a power of two, so that scaling rounds nothing): the largest offset lies in [1, 2).
template <class Real>
struct Star {
  std::vector<StarTriangle<Real>> triangles;
  std::vector<StarQuadrilateral<Real>> quadrilaterals;
  Vec2<Real> box;      // width and height of the bounding box of the other vertices
  double scale = 1.0;  // mesh units
};

/// The elements of a star, wherever they stand.
template <class Real>
class StarView {
 public:
  DMOSCOPE_ANYWHERE StarView(const Star<Real>& star)  // NOLINT(google-explicit-constructor): a view of it
      : StarView(star.triangles.data(), star.triangles.size(), star.quadrilaterals.data(), star.quadrilaterals.size()) {}
  DMOSCOPE_ANYWHERE StarView(const StarTriangle<Real>* triangles, std::size_t triangle_count, const StarQuadrilateral<Real>* quadrilaterals,
                             std::size_t quadrilateral_count)
      : triangles_(triangles, triangle_count), quadrilaterals_(quadrilaterals, quadrilateral_count) {}
  [[nodiscard]] DMOSCOPE_ANYWHERE std::span<const StarTriangle<Real>> triangles() const { return triangles_; }
  [[nodiscard]] DMOSCOPE_ANYWHERE std::span<const StarQuadrilateral<Real>> quadrilaterals() const { return quadrilaterals_; }
  /// Calls f with each triangle, then, unless told that f does not take them, with each quadrilateral.
  template <bool Quadrilaterals, class F>
  DMOSCOPE_ANYWHERE void for_each(F f) const {
    for (const StarTriangle<Real>& t : triangles_) f(t);
    if constexpr (Quadrilaterals)
      for (const StarQuadrilateral<Real>& q : quadrilaterals_) f(q);
  }

 private:
  std::span<const StarTriangle<Real>> triangles_;
  std::span<const StarQuadrilateral<Real>> quadrilaterals_;
};

}  // namespace dmoscope
