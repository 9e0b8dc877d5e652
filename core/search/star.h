#pragma once
// The star of one vertex in the form that the search uses: offsets from the vertex in the mesh's plane or in space, scaled so that the
// largest is about 1.

#include <array>
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "core/base/host_device.h"
#include "core/base/vec.h"
#include "core/mesh/plane.h"
#include "core/quality/formulas.h"

namespace dmoscope {

/// A point, copied into every slot if R is a pack.
template <class R, class Real>
[[nodiscard]] DMOSCOPE_ANYWHERE Vec2<R> point_of(Vec2<Real> p) {
  return {R(p.x), R(p.y)};
}
template <class R, class Real>
[[nodiscard]] DMOSCOPE_ANYWHERE Vec3Of<R> point_of(Vec3Of<Real> p) {
  return {R(p.x), R(p.y), R(p.z)};
}

/// An incident triangle: its other two corners in the element's order, and its reference measure for untangling.
template <class Real>
struct StarTriangle {
  static constexpr Index kMoving = 0;  // place of the vertex among the corners
  static constexpr bool kIsTriangle = true;
  Vec2<Real> b, c;
  Real reference;
  /// The element with the star's vertex at `p`: a point, or a pack of points if the element consists of plain numbers.
  template <class R>
  [[nodiscard]] DMOSCOPE_ANYWHERE auto with(Vec2<R> p) const {
    return formulas::Triangle<Vec2<R>>(p, point_of<R>(b), point_of<R>(c));
  }
};
/// An incident quadrilateral: its other three corners in the element's order, and its reference measure.
template <class Real>
struct StarQuadrilateral {
  static constexpr Index kMoving = 0;
  Vec2<Real> b, c, d;
  Real reference;
  template <class R>
  [[nodiscard]] DMOSCOPE_ANYWHERE auto with(Vec2<R> p) const {
    return formulas::Quadrilateral<Vec2<R>>(p, point_of<R>(b), point_of<R>(c), point_of<R>(d));
  }
};

/// The star of a vertex of a planar mesh, in units of `scale` (a power of two, so that scaling rounds nothing): the largest offset lies in
/// [1, 2).
template <class Real>
struct Star {
  std::vector<StarTriangle<Real>> triangles;
  std::vector<StarQuadrilateral<Real>> quadrilaterals;
  Vec2<Real> box;      // width and height of the bounding box of the other vertices
  double scale = 1.0;  // the star's unit, in mesh units
};

/// A view of a star's elements, in any memory.
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
  /// Calls f with each triangle and, if Quadrilaterals is set, then with each quadrilateral.
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

/// An incident tetrahedron: its other three corners, in an order that makes it positive with the vertex as its first.
template <class Real>
struct StarTetrahedron {
  static constexpr Index kMoving = 0;
  Vec3Of<Real> b, c, d;
  Real reference;
  template <class R>
  [[nodiscard]] DMOSCOPE_ANYWHERE auto with(Vec3Of<R> p) const {
    return formulas::Tetrahedron<Vec3Of<R>>(p, point_of<R>(b), point_of<R>(c), point_of<R>(d));
  }
};
/// Any other incident volume element (formulas::Hexahedron and so on), turned so that the vertex is its first corner, or the last of a
/// pyramid. Its other corners come in order.
template <template <class> class SolidT, std::size_t N, class Real>
struct StarSolid {
  static constexpr Index kMoving = 0;
  static constexpr std::size_t kOthers = N;
  std::array<Vec3Of<Real>, N> others;
  Real reference;
  template <class R>
  [[nodiscard]] DMOSCOPE_ANYWHERE auto with(Vec3Of<R> p) const {
    SolidT<Vec3Of<R>> solid{};
    solid.at[0] = p;
    for (std::size_t i = 0; i < N; ++i) solid.at[i + 1] = point_of<R>(others[i]);
    return solid;
  }
};
template <class Real>
using StarHexahedron = StarSolid<formulas::Hexahedron, 7, Real>;
template <class Real>
using StarWedge = StarSolid<formulas::Wedge, 5, Real>;
/// An incident pyramid of whose base the vertex is a corner.
template <class Real>
using StarPyramid = StarSolid<formulas::Pyramid, 4, Real>;
/// An incident pyramid whose apex is the vertex.
template <class Real>
struct StarTip {
  static constexpr Index kMoving = 4;
  std::array<Vec3Of<Real>, 4> base;
  Real reference;
  template <class R>
  [[nodiscard]] DMOSCOPE_ANYWHERE auto with(Vec3Of<R> p) const {
    return formulas::Pyramid<Vec3Of<R>>{{point_of<R>(base[0]), point_of<R>(base[1]), point_of<R>(base[2]), point_of<R>(base[3]), p}};
  }
};

/// The star of a vertex of a volume mesh, in units of `scale`, its largest offset.
template <class Real>
struct VolumeStar {
  std::vector<StarTetrahedron<Real>> tetrahedra;
  std::vector<StarHexahedron<Real>> hexahedra;
  std::vector<StarWedge<Real>> wedges;
  std::vector<StarPyramid<Real>> pyramids;
  std::vector<StarTip<Real>> tips;
  Vec3Of<Real> box;
  double scale = 1.0;

  /// Calls f with each of the star's lists in turn.
  template <class F>
  void for_each_list(F f) {
    f(tetrahedra), f(hexahedra), f(wedges), f(pyramids), f(tips);
  }
};

/// A list of a star's elements in any memory: plain data.
template <class T>
struct ListView {
  const T* data = nullptr;
  std::size_t size = 0;
};

/// The lists of a star as plain data, for kernels of different processors. Real: float or double.
template <class Real>
struct PlanarLists {
  ListView<StarTriangle<Real>> simplices;
  ListView<StarQuadrilateral<Real>> quadrilaterals;
  /// Calls f with each element that is no simplex.
  template <class F>
  void for_others(F f) const {
    for (std::size_t i = 0; i < quadrilaterals.size; ++i) f(quadrilaterals.data[i]);
  }
};
template <class Real>
struct SolidLists {
  ListView<StarTetrahedron<Real>> simplices;
  ListView<StarHexahedron<Real>> hexahedra;
  ListView<StarWedge<Real>> wedges;
  ListView<StarPyramid<Real>> pyramids;
  ListView<StarTip<Real>> tips;
  template <class F>
  void for_others(F f) const {
    for (std::size_t i = 0; i < hexahedra.size; ++i) f(hexahedra.data[i]);
    for (std::size_t i = 0; i < wedges.size; ++i) f(wedges.data[i]);
    for (std::size_t i = 0; i < pyramids.size; ++i) f(pyramids.data[i]);
    for (std::size_t i = 0; i < tips.size; ++i) f(tips.data[i]);
  }
};

template <class Real>
class VolumeStarView {
 public:
  VolumeStarView(const VolumeStar<Real>& star) : star_(&star) {}  // NOLINT(google-explicit-constructor): a view of it
  /// Calls f with each tetrahedron and, if Others is set, then with each other element.
  template <bool Others, class F>
  void for_each(F f) const {
    for (const auto& t : star_->tetrahedra) f(t);
    if constexpr (Others) {
      for (const auto& h : star_->hexahedra) f(h);
      for (const auto& w : star_->wedges) f(w);
      for (const auto& p : star_->pyramids) f(p);
      for (const auto& p : star_->tips) f(p);
    }
  }

 private:
  const VolumeStar<Real>* star_;
};

template <class T>
[[nodiscard]] ListView<T> list_of(const std::vector<T>& list) {
  return {list.data(), list.size()};
}
template <class Real>
[[nodiscard]] PlanarLists<Real> lists_of(const Star<Real>& star) {
  return {list_of(star.triangles), list_of(star.quadrilaterals)};
}
template <class Real>
[[nodiscard]] SolidLists<Real> lists_of(const VolumeStar<Real>& star) {
  return {list_of(star.tetrahedra), list_of(star.hexahedra), list_of(star.wedges), list_of(star.pyramids), list_of(star.tips)};
}

/// The star's type in a frame, Plane or Space.
template <class Frame, class Real>
using StarIn = std::conditional_t<std::is_same_v<Frame, Plane>, Star<Real>, VolumeStar<Real>>;
template <class Frame, class Real>
using StarListsIn = std::conditional_t<std::is_same_v<Frame, Plane>, PlanarLists<Real>, SolidLists<Real>>;
template <class Frame, class Real>
using StarViewIn = std::conditional_t<std::is_same_v<Frame, Plane>, StarView<Real>, VolumeStarView<Real>>;

}  // namespace dmoscope
