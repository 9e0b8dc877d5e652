#pragma once
// Several vertices' stars side by side, one a slot of a pack.

#include <algorithm>
#include <span>

#include "core/search/star.h"

namespace dmoscope {

/// A lane that holds W vertices. The slots' stars may have different valences: short ones repeat their first element, which changes
/// no minimum. Slots must agree on having triangles at all and on having quadrilaterals at all.
template <int W>
class PackedStar {
 public:
  /// Do these stars fit side by side?
  [[nodiscard]] static bool alike(std::span<const Star<float>> stars) {
    for (const Star<float>& star : stars)
      if (star.triangles.empty() != stars[0].triangles.empty() || star.quadrilaterals.empty() != stars[0].quadrilaterals.empty())
        return false;
    return true;
  }

  /// Packs `stars` (1 to W of them, alike); slots without one repeat the first.
  const Star<Pack<W>>& pack(std::span<const Star<float>> stars) {
    std::size_t triangles = 0, quadrilaterals = 0;
    for (const Star<float>& star : stars) {
      triangles = std::max(triangles, star.triangles.size());
      quadrilaterals = std::max(quadrilaterals, star.quadrilaterals.size());
    }
    packed_.triangles.resize(triangles);
    packed_.quadrilaterals.resize(quadrilaterals);
    for (std::size_t i = 0; i < W; ++i) {
      const Star<float>& star = stars[i < stars.size() ? i : 0];
      packed_.box.x[i] = star.box.x;
      packed_.box.y[i] = star.box.y;
      for (std::size_t t = 0; t < triangles; ++t) {
        const StarTriangle<float>& from = star.triangles[t < star.triangles.size() ? t : 0];
        StarTriangle<Pack<W>>& to = packed_.triangles[t];
        set(to.b, i, from.b);
        set(to.c, i, from.c);
        to.reference[i] = from.reference;
      }
      for (std::size_t q = 0; q < quadrilaterals; ++q) {
        const StarQuadrilateral<float>& from = star.quadrilaterals[q < star.quadrilaterals.size() ? q : 0];
        StarQuadrilateral<Pack<W>>& to = packed_.quadrilaterals[q];
        set(to.b, i, from.b);
        set(to.c, i, from.c);
        set(to.d, i, from.d);
        to.reference[i] = from.reference;
      }
    }
    return packed_;
  }

 private:
  static void set(Vec2<Pack<W>>& to, std::size_t slot, Vec2<float> from) {
    to.x[slot] = from.x;
    to.y[slot] = from.y;
  }
  Star<Pack<W>> packed_;
};

}  // namespace dmoscope
