#pragma once
// Smooth functions of which the quality of a star is the least, by a metric that is defined by a formula or a target.

#include <array>
#include <vector>

#include "core/formula/dual_program.h"
#include "core/search/defined_star.h"
#include "core/smooth/visit/star_pieces.h"

namespace dmoscope {

/// Numbers of one element that a piece is given: its corners in its frame, and the movement of its moving corner.
template <class Frame>
struct PieceCorners {
  using R = std::conditional_t<std::is_same_v<Frame, Space>, SolidDual, Dual>;
  std::array<Vec3, 8> at{};
  std::array<R, 3> moving{};
  Vec3 origin{};
  Plane plane{};  // plane of an element of a surface
};
/// Corners for a piece. `p`: the place of the star's vertex, in units of `scale` mesh units from its present one.
template <class Frame>
[[nodiscard]] PieceCorners<Frame> piece_corners(const DefinedStarJudge<Frame>& star, PositionView positions, Index vertex,
                                                const Incidence& incidence, double scale, OffsetIn<Frame, double> p) {
  PieceCorners<Frame> result;
  const auto corners = star.mesh.corners_of(incidence.element);
  const Vec3 here = positions[vertex];
  const auto coordinates = []<class V>(const V& offset) {
    if constexpr (std::is_same_v<V, Vec3>)
      return offset;
    else
      return Vec3{offset.x, offset.y, 0.0};
  };
  if constexpr (std::is_same_v<Frame, Curved>) {
    const auto at = [&](Index v) { return v == vertex ? here + scale * p.v : positions[v]; };
    result.plane = star.frames.gather(corners, incidence.element, 2, at, result.at);
    const Vec3 moving = result.at[incidence.corner];
    result.moving = {Dual(moving.x, {scale, 0.0}), Dual(moving.y, {0.0, scale}), Dual(0.0)};
  } else {
    for (std::size_t i = 0; i < corners.size(); ++i) result.at[i] = coordinates(star.mesh.frame.offset(positions[corners[i]], here));
    result.origin = coordinates(star.mesh.frame.offset(here, Vec3{}));
    using R = typename PieceCorners<Frame>::R;
    const auto way = variable(p);
    result.moving = {way.x * R(scale), way.y * R(scale), R(0.0)};
    if constexpr (std::is_same_v<Frame, Space>) result.moving[2] = way.z * R(scale);
  }
  return result;
}

/// Appends the pieces with the star's vertex at `p`. In volumes only those that change with its place: the others say nothing about where
/// it should be.
template <class Frame>
void append_defined_pieces(const DefinedStarJudge<Frame>& star, PositionView positions, Index vertex, double scale,
                           OffsetIn<Frame, double> p, std::vector<StarPiece<Frame>>& out) {
  using R = typename PieceCorners<Frame>::R;
  thread_local std::vector<R> room;
  for (const Incidence& at : star.mesh.star(vertex)) {
    const ElementTarget target = star.judge.targets().of(at.element);
    const PieceCorners<Frame> corners = piece_corners(star, positions, vertex, at, scale, p);
    for (const FormulaPiece& piece : star.judge.metric().formula->pieces(star.kinds[at.element], target.space)) {
      const bool moves = (piece.corners >> at.corner & 1U) != 0;
      if (!moves && std::is_same_v<Frame, Space>) continue;
      const R value = run_program<R>(
          piece.program,
          [&](const FormulaInput& input) -> R {
            const auto coordinate = [&](const Vec3& of) { return R(input.row == 0 ? of.x : input.row == 1 ? of.y : of.z); };
            if (input.what == FormulaInput::What::Origin) return coordinate(corners.origin);
            if (input.what != FormulaInput::What::Corner) return R(star.judge.given(input, at.element, target, 1.0));
            return input.index == at.corner ? corners.moving[input.row] : coordinate(corners.at[input.index]);
          },
          room);
      const R steep = steeper(value, target.steepness);
      if constexpr (std::is_same_v<Frame, Curved>)
        out.push_back({steep.value, corners.plane.lift(steep.by)});
      else
        out.push_back({steep.value, steep.by});
    }
  }
}

}  // namespace dmoscope
