#pragma once
// The star of a vertex as a lane sees it, list after list.

#include <type_traits>

#include "core/search/mesh_star.h"
#include "core/smooth/kernels/volume_kernel.h"

namespace dmoscope::gpu {

/// Number of the list of a Star or VolumeStar that holds an element.
template <class Element>
inline constexpr unsigned kListOf = 0;
template <class Real>
inline constexpr unsigned kListOf<StarQuadrilateral<Real>> = 1;
template <class Real>
inline constexpr unsigned kListOf<StarHexahedron<Real>> = 1;
template <class Real>
inline constexpr unsigned kListOf<StarWedge<Real>> = 2;
template <class Real>
inline constexpr unsigned kListOf<StarPyramid<Real>> = 3;
template <class Real>
inline constexpr unsigned kListOf<StarTip<Real>> = 4;

/// Star that is read straight from the mesh, since a lane has no memory for lists, and still list after list, in the order of StarView and
/// VolumeStarView: a mean over the elements is summed in that order. Frame: Plane or Space.
template <class Frame>
class ListedStar {
 public:
  DMOSCOPE_ANYWHERE ListedStar(const MeshView<Frame>& mesh, PositionView positions, Index vertex) : star_(mesh, positions, vertex) {
    std::size_t sizes[kLists] = {};
    star_.template for_each<true>([&sizes](const auto& element) { ++sizes[list_of(element)]; });
    for (unsigned list = 0; list < kLists; ++list) {
      if (sizes[list] > 0) lists_ |= 1U << list;
      if (sizes[list] > kMaxSolids) fits_ = false;
    }
  }

  [[nodiscard]] DMOSCOPE_ANYWHERE const MeshStar<Frame>& star() const { return star_; }
  /// Whether no list has more elements than the fast search of volumes takes.
  [[nodiscard]] DMOSCOPE_ANYWHERE bool fits() const { return fits_; }

  /// Calls f(element) for each element: see StarView and VolumeStarView.
  template <bool Others, class F>
  DMOSCOPE_ANYWHERE void for_each(F f) const {
    for (unsigned list = 0; list < (Others ? kLists : 1U); ++list) {
      if ((lists_ >> list & 1U) == 0) continue;
      star_.template for_each<Others>([&f, list](const auto& element) {
        if (list_of(element) == list) f(element);
      });
    }
  }

 private:
  static constexpr unsigned kLists = std::is_same_v<Frame, Plane> ? 2 : 5;
  template <class Element>
  [[nodiscard]] static DMOSCOPE_ANYWHERE unsigned list_of(const Element& /*element*/) {
    return kListOf<Element>;
  }

  MeshStar<Frame> star_;
  unsigned lists_ = 0;  // one bit for each list that has elements
  bool fits_ = true;
};

}  // namespace dmoscope::gpu
