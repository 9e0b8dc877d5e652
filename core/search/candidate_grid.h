#pragma once
// The grid of candidates around a vertex, and the best of them.

#include <type_traits>

#include "core/base/host_device.h"
#include "core/base/vec.h"
#include "core/numeric/scalar.h"
#include "core/search/team.h"

namespace dmoscope {

/// The best candidate of all levels: its offset from the vertex (units of the star's scale) and its objective.
template <class Real, class Point = Vec2<Real>>
struct Candidate {
  Point offset{};
  Real objective{};
};

/// Product of each coordinate with `s`.
template <class Real>
[[nodiscard]] DMOSCOPE_ANYWHERE Vec2<Real> times(Vec2<Real> a, Real s) {
  return {a.x * s, a.y * s};
}
template <class Real>
[[nodiscard]] DMOSCOPE_ANYWHERE Vec3Of<Real> times(Vec3Of<Real> a, Real s) {
  return {a.x * s, a.y * s, a.z * s};
}
/// One level's grid of n points per axis: candidate (i, j) or (i, j, k), each from 0 to n - 1, is centre + ((i, j, k) / (n - 1) - 1/2) *
/// size; its index is i * n + j, or (i * n + j) * n + k.
template <class Real, class Point = Vec2<Real>>
struct CandidateGrid {
  Point centre{};
  Point size{};
  int points = 0;
  [[nodiscard]] DMOSCOPE_ANYWHERE Point at(int i, int j) const requires std::is_same_v<Point, Vec2<Real>> {
    return {coordinate(centre.x, size.x, i), coordinate(centre.y, size.y, j)};
  }
  [[nodiscard]] DMOSCOPE_ANYWHERE Point at(int i, int j, int k) const requires std::is_same_v<Point, Vec3Of<Real>> {
    return {coordinate(centre.x, size.x, i), coordinate(centre.y, size.y, j), coordinate(centre.z, size.z, k)};
  }
  /// Calls f(index, candidate) for all candidates of one i, in the order of their indices.
  template <class F>
  DMOSCOPE_INLINE DMOSCOPE_ANYWHERE void for_slice(int i, F f) const {
    for (int j = 0; j < points; ++j) {
      if constexpr (std::is_same_v<Point, Vec2<Real>>) {
        f(i * points + j, at(i, j));
      } else {
        for (int k = 0; k < points; ++k) f((i * points + j) * points + k, at(i, j, k));
      }
    }
  }

 private:
  [[nodiscard]] DMOSCOPE_ANYWHERE Real coordinate(Real middle, Real width, int i) const {
    return middle + width * (scalar::constant<Real>(i) / scalar::constant<Real>(points - 1) - Real(0.5F));
  }
};

/// The best candidate of a team's lanes; of several equal ones that of lowest index.
template <class Real, class Point, class Team>
[[nodiscard]] DMOSCOPE_ANYWHERE Candidate<Real, Point> best_of_team(const Team& team, const Candidate<Real, Point>& mine, int index) {
  struct Found {
    Candidate<Real, Point> candidate;
    int index;
  };
  return fold(team, Found{mine, index},
              [](const Found& a, const Found& b) {
                const bool second =
                    b.candidate.objective > a.candidate.objective || (b.candidate.objective == a.candidate.objective && b.index < a.index);
                return second ? b : a;
              })
      .candidate;
}

}  // namespace dmoscope
