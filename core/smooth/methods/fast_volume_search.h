#pragma once
// The fast search of a volume's star: in float by the kernel, confirmed in double.

#include <cstddef>
#include <optional>
#include <vector>

#include "core/smooth/kernels/volume_kernel.h"
#include "core/smooth/vertex_rule.h"

namespace dmoscope {

/// A star in both precisions.
struct VolumeScratch {
  VolumeStar<double> exact;
  VolumeStar<float> fast;
};

namespace in_float {

inline Vec3Of<float> narrow(Vec3 p) { return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)}; }
inline StarTetrahedron<float> narrow(const StarTetrahedron<double>& t) { return {narrow(t.b), narrow(t.c), narrow(t.d), 1.0F}; }
inline StarTip<float> narrow(const StarTip<double>& t) {
  return {{narrow(t.base[0]), narrow(t.base[1]), narrow(t.base[2]), narrow(t.base[3])}, 1.0F};
}
template <class Narrow, template <class> class Element, std::size_t N>
Narrow narrow_others(const StarSolid<Element, N, double>& s) {
  Narrow result{};
  for (std::size_t i = 0; i < N; ++i) result.others[i] = narrow(s.others[i]);
  result.reference = 1.0F;
  return result;
}
inline StarHexahedron<float> narrow(const StarHexahedron<double>& h) { return narrow_others<StarHexahedron<float>>(h); }
inline StarWedge<float> narrow(const StarWedge<double>& w) { return narrow_others<StarWedge<float>>(w); }
inline StarPyramid<float> narrow(const StarPyramid<double>& p) { return narrow_others<StarPyramid<float>>(p); }

template <class From, class To>
void narrow_list(const std::vector<From>& from, std::vector<To>& to) {
  to.clear();
  for (const From& element : from) to.push_back(narrow(element));
}

}  // namespace in_float

/// The fast search for a vertex, and the plain one for stars that the fast one cannot handle: with inverted or nearly inverted elements, or
/// too many. The mesh must outlive it.
template <Metric M>
class FastVolumeSearch {
 public:
  using Scratch = VolumeScratch;
  static constexpr bool kDependsOnStarAlone = true;
  static constexpr std::size_t kGrain = 16;
  FastVolumeSearch(const InputMesh& input, const SearchParameters& parameters)
      : mesh_(input), parameters_(parameters), kernel_(volume_kernel(parameters.simd.value_or(best_simd_level()), M)) {}

  void begin(const Sweep& sweep) { mesh_.untangling = sweep.untangling; }
  std::optional<Vec3> target(PositionView positions, Index vertex, VolumeScratch& scratch) const {
    const MeshStar star(mesh_.view, positions, vertex);
    gather_star(star, scratch.exact);
    const VolumeFound found = mesh_.untangling.repair ? VolumeFound{} : find(scratch, parameters_.levels);
    if (!found.ready) return target_by_plain_search(positions, vertex, scratch.exact);
    const Vec3 offset{found.offset.x, found.offset.y, found.offset.z};
    if (offset == Vec3{}) return std::nullopt;
    return mesh_.template moved_if_gaining<M>(positions, vertex, offset, scratch.exact.scale);
  }

  /// What the kernel finds within `levels` levels for the star in scratch.exact; a search of fewer levels begins like one of more. Not
  /// ready where the plain search has to do it.
  [[nodiscard]] VolumeFound find(VolumeScratch& scratch, int levels) const {
    return fits(scratch.exact) ? kernel_(search_of(scratch, levels)) : VolumeFound{};
  }

 private:
  static bool fits(VolumeStar<double>& star) {
    bool fits = true;
    star.for_each_list([&fits](const auto& list) { fits = fits && list.size() <= kMaxSolids; });
    return fits;
  }

  [[nodiscard]] VolumeSearch search_of(VolumeScratch& scratch, int levels) const {
    in_float::narrow_list(scratch.exact.tetrahedra, scratch.fast.tetrahedra);
    in_float::narrow_list(scratch.exact.hexahedra, scratch.fast.hexahedra);
    in_float::narrow_list(scratch.exact.wedges, scratch.fast.wedges);
    in_float::narrow_list(scratch.exact.pyramids, scratch.fast.pyramids);
    in_float::narrow_list(scratch.exact.tips, scratch.fast.tips);
    VolumeSearch search;
    search.star = lists_of(scratch.fast);
    search.box = in_float::narrow(scratch.exact.box);
    search.points = parameters_.grid_points;
    search.levels = levels;
    search.omega = parameters_.omega;
    return search;
  }

  std::optional<Vec3> target_by_plain_search(PositionView positions, Index vertex, const VolumeStar<double>& star) const {
    const Vec3 found = search_star<M>(VolumeStarView<double>(star), star.box, parameters_, mesh_.untangling);
    if (found == Vec3{}) return std::nullopt;
    return mesh_.template moved_if_gaining<M>(positions, vertex, found, star.scale);
  }

  RuleMesh<Space> mesh_;
  SearchParameters parameters_;
  VolumeKernel kernel_;
};

}  // namespace dmoscope
