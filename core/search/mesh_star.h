#pragma once
// The star of one vertex straight from the mesh.

#include <cmath>

#include "core/base/anywhere.h"
#include "core/mesh/planar_view.h"
#include "core/mesh/position_view.h"
#include "core/quality/scalar.h"
#include "core/search/star.h"

namespace dmoscope {

/// Reads the mesh anew at every look, so that it needs no memory, whatever the star's size: for a GPU's lanes. gather_star() copies it for
/// those who look often.
class MeshStar {
 public:
  DMOSCOPE_ANYWHERE MeshStar(const PlanarView& mesh, PositionView positions, Index vertex)
      : mesh_(mesh), positions_(positions), vertex_(vertex), origin_(positions[vertex]) {
    Vec2<double> low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
    for (const Incidence& at : mesh_.star(vertex_)) {
      const auto corners = mesh_.corners_of(at.element);
      for (std::size_t i = 1; i < corners.size(); ++i) {
        const Vec2<double> p = offset(corners, at.corner, i);
        low = {scalar::min(low.x, p.x), scalar::min(low.y, p.y)};
        high = {scalar::max(high.x, p.x), scalar::max(high.y, p.y)};
      }
    }
    const double width = scalar::max(scalar::abs(low.x), scalar::abs(high.x)),
                 height = scalar::max(scalar::abs(low.y), scalar::abs(high.y));
    const double extent = scalar::max(width, height);
    scale_ = extent > 0.0 && extent < HUGE_VAL ? std::ldexp(1.0, std::ilogb(extent)) : 1.0;
    inverse_ = 1.0 / scale_;
    box_ = scaled(high - low);
  }

  /// Width and height of the bounding box of the other vertices, in units of scale().
  [[nodiscard]] DMOSCOPE_ANYWHERE Vec2<double> box() const { return box_; }
  /// A power of two, in mesh units: the largest offset lies in [1, 2) of it.
  [[nodiscard]] DMOSCOPE_ANYWHERE double scale() const { return scale_; }

  /// See StarView; in the order of the elements.
  template <bool Quadrilaterals, class F>
  DMOSCOPE_ANYWHERE void for_each(F f) const {
    for (const Incidence& at : mesh_.star(vertex_)) {
      const auto corners = mesh_.corners_of(at.element);
      const double reference = mesh_.reference_measure[at.element] * inverse_ * inverse_;
      const Vec2<double> b = scaled(offset(corners, at.corner, 1)), c = scaled(offset(corners, at.corner, 2));
      if (corners.size() == 3)
        f(StarTriangle<double>{b, c, reference});
      else if constexpr (Quadrilaterals)
        f(StarQuadrilateral<double>{b, c, scaled(offset(corners, at.corner, 3)), reference});
    }
  }

 private:
  /// Of the corner `i` places after the vertex.
  [[nodiscard]] DMOSCOPE_ANYWHERE Vec2<double> offset(std::span<const Index> corners, Index corner, std::size_t i) const {
    return mesh_.plane.project(positions_[corners[(corner + i) % corners.size()]] - origin_);
  }
  [[nodiscard]] DMOSCOPE_ANYWHERE Vec2<double> scaled(Vec2<double> p) const { return {p.x * inverse_, p.y * inverse_}; }

  PlanarView mesh_;
  PositionView positions_;
  Index vertex_;
  Vec3 origin_;
  Vec2<double> box_;
  double scale_ = 1.0, inverse_ = 1.0;
};

/// Fills `out` (its vectors are reused). A star shrunk to a point has an empty box.
void gather_star(const MeshStar& star, Star<double>& out);

}  // namespace dmoscope
