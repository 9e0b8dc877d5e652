#pragma once
// The star of one vertex, read directly from the mesh.

#include <cmath>
#include <cstdint>
#include <limits>

#include "core/base/host_device.h"
#include "core/mesh/mesh_view.h"
#include "core/mesh/position_view.h"
#include "core/numeric/scalar.h"
#include "core/search/star.h"

namespace dmoscope {

namespace turned {

/// Corner i of a volume element that is turned so that corner `c` is the first and it stays positive; a pyramid's apex stays the last.
[[nodiscard]] DMOSCOPE_ANYWHERE Index tetrahedron(Index c, Index i) { return c ^ i; }
[[nodiscard]] DMOSCOPE_ANYWHERE Index pyramid(Index c, Index i) { return i < 4 ? (c + i) % 4 : 4; }
[[nodiscard]] DMOSCOPE_ANYWHERE Index wedge(Index c, Index i) {
  const Index around = i % 3;
  if (c < 3) return (c + around) % 3 + (i < 3 ? 0U : 3U);
  return (c + 3 - around) % 3 + (i < 3 ? 3U : 0U);
}
[[nodiscard]] DMOSCOPE_ANYWHERE Index hexahedron(Index c, Index i) {
  const Index around = i % 4;
  if (c < 4) return (c + around) % 4 + (i < 4 ? 0U : 4U);
  return (c + 4 - around) % 4 + (i < 4 ? 4U : 0U);
}

}  // namespace turned

/// Bounding box of offsets.
template <class Offset>
class StarBox {
 public:
  DMOSCOPE_ANYWHERE void add(Offset p) {
    low_ = empty_ ? p : lower(low_, p);
    high_ = empty_ ? p : upper(high_, p);
    empty_ = false;
  }
  /// The largest coordinate.
  [[nodiscard]] DMOSCOPE_ANYWHERE double largest() const { return scalar::max(greatest(low_), greatest(high_)); }
  [[nodiscard]] DMOSCOPE_ANYWHERE Offset size() const { return high_ - low_; }

 private:
  using P2 = Vec2<double>;
  static DMOSCOPE_ANYWHERE P2 lower(P2 a, P2 b) { return {scalar::min(a.x, b.x), scalar::min(a.y, b.y)}; }
  static DMOSCOPE_ANYWHERE P2 upper(P2 a, P2 b) { return {scalar::max(a.x, b.x), scalar::max(a.y, b.y)}; }
  static DMOSCOPE_ANYWHERE double greatest(P2 a) { return scalar::max(scalar::abs(a.x), scalar::abs(a.y)); }
  static DMOSCOPE_ANYWHERE Vec3 lower(Vec3 a, Vec3 b) { return {scalar::min(a.x, b.x), scalar::min(a.y, b.y), scalar::min(a.z, b.z)}; }
  static DMOSCOPE_ANYWHERE Vec3 upper(Vec3 a, Vec3 b) { return {scalar::max(a.x, b.x), scalar::max(a.y, b.y), scalar::max(a.z, b.z)}; }
  static DMOSCOPE_ANYWHERE double greatest(Vec3 a) { return scalar::max3(scalar::abs(a.x), scalar::abs(a.y), scalar::abs(a.z)); }

  Offset low_{}, high_{};
  bool empty_ = true;
};

/// The unit of a star whose largest offset is `extent`. In the plane it is a power of two, so that scaling rounds nothing. In space it is
/// the extent itself: the fast search's floats then do not depend on the unit of length. (In the plane that search has units of its own:
/// SearchFrame.)
template <class Frame>
[[nodiscard]] DMOSCOPE_ANYWHERE double star_scale(double extent) {
  if (!(extent > 0.0 && extent < HUGE_VAL)) return 1.0;
  const double power = std::ldexp(1.0, std::ilogb(extent));
  return std::is_same_v<Frame, Plane> || !(power >= std::numeric_limits<double>::min()) ? power : extent;
}

/// A star that reads the mesh whenever it is used, so that it needs no memory, whatever its size: for a GPU's lanes. gather_star() makes a
/// copy for code that reads a star often. Frame: Plane or Space.
template <class Frame>
class MeshStar {
 public:
  using Offset = OffsetIn<Frame, double>;

  DMOSCOPE_ANYWHERE MeshStar(const MeshView<Frame>& mesh, PositionView positions, Index vertex)
      : mesh_(mesh), positions_(positions), vertex_(vertex), origin_(positions[vertex]) {
    StarBox<Offset> box;
    for (const Incidence& at : mesh_.star(vertex_)) {
      const auto corners = mesh_.corners_of(at.element);
      for (std::size_t i = 0; i < corners.size(); ++i)
        if (i != at.corner) box.add(offset(corners, i));
    }
    scale_ = star_scale<Frame>(box.largest());
    inverse_ = 1.0 / scale_;
    box_ = scaled(box.size());
  }

  /// The bounding box of the other vertices, in units of scale().
  [[nodiscard]] DMOSCOPE_ANYWHERE Offset box() const { return box_; }
  /// The star's unit, in mesh units: the largest offset lies in [1, 2) of it.
  [[nodiscard]] DMOSCOPE_ANYWHERE double scale() const { return scale_; }

  /// Calls f with each element in the order of the mesh, see StarView. Others: also with elements that are no simplices.
  template <bool Others, class F>
  DMOSCOPE_ANYWHERE void for_each(F f) const {
    for (const Incidence& at : mesh_.star(vertex_)) visit<Others>(at, f);
  }
  /// An element's reference measure, in units of the star's.
  [[nodiscard]] DMOSCOPE_ANYWHERE double reference_of(Index element) const {
    return mesh_.reference_measure[element] * measure_of(inverse_);
  }
  /// Calls f with one element of the star.
  template <bool Others, class F>
  DMOSCOPE_ANYWHERE void visit(const Incidence& at, F& f) const {
    const auto corners = mesh_.corners_of(at.element);
    const double reference = reference_of(at.element);
    if constexpr (std::is_same_v<Frame, Plane>)
      visit_planar_element<Others>(corners, at.corner, reference, f);
    else
      visit_volume_element<Others>(corners, at.corner, reference, f);
  }

 private:
  /// The factor of areas or volumes if lengths grow by the factor `length`.
  static DMOSCOPE_ANYWHERE double measure_of(double length) {
    return std::is_same_v<Frame, Plane> ? length * length : length * length * length;
  }
  [[nodiscard]] DMOSCOPE_ANYWHERE Offset offset(std::span<const Index> corners, std::size_t corner) const {
    return mesh_.frame.offset(positions_[corners[corner]], origin_);
  }
  [[nodiscard]] DMOSCOPE_ANYWHERE Vec2<double> scaled(Vec2<double> p) const { return {p.x * inverse_, p.y * inverse_}; }
  [[nodiscard]] DMOSCOPE_ANYWHERE Vec3 scaled(Vec3 p) const { return {p.x * inverse_, p.y * inverse_, p.z * inverse_}; }

  template <bool Others, class F>
  DMOSCOPE_ANYWHERE void visit_planar_element(std::span<const Index> corners, Index corner, double reference, F& f) const {
    const auto after = [&](std::size_t i) {
      const std::size_t c = corner + i;
      return scaled(offset(corners, c < corners.size() ? c : c - corners.size()));
    };
    if (corners.size() == 3)
      f(StarTriangle<double>{after(1), after(2), reference});
    else if constexpr (Others)
      f(StarQuadrilateral<double>{after(1), after(2), after(3), reference});
  }

  template <bool Others, class F>
  DMOSCOPE_ANYWHERE void visit_volume_element(std::span<const Index> corners, Index corner, double reference, F& f) const {
    const auto at = [&](Index i) { return scaled(offset(corners, i)); };
    if (corners.size() == 4) {
      f(StarTetrahedron<double>{at(turned::tetrahedron(corner, 1)), at(turned::tetrahedron(corner, 2)), at(turned::tetrahedron(corner, 3)),
                                reference});
    } else if constexpr (Others) {
      const auto visit = [&]<class Element>(Element element, Index (*turn)(Index, Index)) {
        for (std::size_t i = 0; i < Element::kOthers; ++i) element.others[i] = at(turn(corner, static_cast<Index>(i + 1)));
        element.reference = reference;
        f(element);
      };
      if (corners.size() == 8)
        visit(StarHexahedron<double>{}, turned::hexahedron);
      else if (corners.size() == 6)
        visit(StarWedge<double>{}, turned::wedge);
      else if (corner < 4)
        visit(StarPyramid<double>{}, turned::pyramid);
      else
        f(StarTip<double>{{at(0), at(1), at(2), at(3)}, reference});
    }
  }

  MeshView<Frame> mesh_;
  PositionView positions_;
  Index vertex_;
  Vec3 origin_;
  Offset box_;
  double scale_ = 1.0, inverse_ = 1.0;
};

/// Gathers the star into `out`, whose vectors are reused. A star shrunk to a point has an empty box.
void gather_star(const MeshStar<Plane>& star, Star<double>& out);
void gather_star(const MeshStar<Space>& star, VolumeStar<double>& out);

}  // namespace dmoscope
