#pragma once
// Elements of a volume's star for the kernels: one by one, or in packs with an element per slot.
//
// Only the kernels' sources include it; see lane_kernel_impl.h for what that asks of the code.

#include <cstddef>
#include <type_traits>

#include "core/numeric/pack.h"
// Headers that must come after the packs:
#include "core/search/star.h"
#include "core/smooth/kernels/indexed_star.h"

namespace dmoscope::volumes {

/// Element of a star whose other corner i is corner(i).
template <class Element, class Corner>
[[gnu::always_inline]] inline Element element_of(const Corner& corner) {
  Element element{};
  using Real = std::remove_cvref_t<decltype(element.reference)>;
  element.reference = Real(1);
  if constexpr (requires { element.others; }) {
    for (std::size_t i = 0; i < Element::kOthers; ++i) element.others[i] = corner(i);
  } else if constexpr (requires { element.base; }) {
    for (std::size_t i = 0; i < 4; ++i) element.base[i] = corner(i);
  } else {
    element.b = corner(0);
    element.c = corner(1);
    element.d = corner(2);
  }
  return element;
}

/// Calls f.template operator()<Element>(corners, count, others) for each kind of elements that the star has: StarTetrahedron<R> and so on;
/// `others` corners an element.
template <class R, class F>
[[gnu::always_inline]] inline void for_kinds(const IndexedStar& star, F f) {
  const std::uint16_t* corners = star.corners;
  const auto kind = [&]<class Element>(StarKind which) {
    const auto index = static_cast<std::size_t>(which);
    const std::size_t count = star.counts[index], others = kOtherCorners[index];
    if (count > 0) f.template operator()<Element>(corners, count, others);
    corners += count * others;
  };
  kind.template operator()<StarTetrahedron<R>>(StarKind::Tetrahedra);
  kind.template operator()<StarHexahedron<R>>(StarKind::Hexahedra);
  kind.template operator()<StarWedge<R>>(StarKind::Wedges);
  kind.template operator()<StarPyramid<R>>(StarKind::Pyramids);
  kind.template operator()<StarTip<R>>(StarKind::Tips);
}

/// Calls take(element, used) with packs of the star's elements, an element per slot; where a kind has no more of them the slots from `used`
/// on repeat its last one. R: pack; Real: its number; `points`: of the star's other vertices.
template <class R, class Real, class Take>
[[gnu::always_inline]] inline void for_packs(const IndexedStar& star, const Vec3Of<Real>* points, const Take& take) {
  constexpr std::size_t kWidth = R::size;
  for_kinds<R>(star, [&]<class Element>(const std::uint16_t* corners, std::size_t count, std::size_t others) {
    alignas(64) Real numbers[7][3][kWidth];
    for (std::size_t first = 0; first < count; first += kWidth) {
      for (std::size_t slot = 0; slot < kWidth; ++slot) {
        const std::size_t element = first + slot < count ? first + slot : count - 1;
        for (std::size_t i = 0; i < others; ++i) {
          const Vec3Of<Real>& point = points[corners[element * others + i]];
          numbers[i][0][slot] = point.x;
          numbers[i][1][slot] = point.y;
          numbers[i][2][slot] = point.z;
        }
      }
      take(element_of<Element>([&](std::size_t i) -> Vec3Of<R> {
             return {R::load_aligned(numbers[i][0]), R::load_aligned(numbers[i][1]), R::load_aligned(numbers[i][2])};
           }),
           count - first < kWidth ? count - first : kWidth);
    }
  });
}

}  // namespace dmoscope::volumes
