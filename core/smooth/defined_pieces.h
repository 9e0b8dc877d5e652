#pragma once
// The smooth functions of which the quality of a star is the least, by a metric that is defined by a formula or a target.

#include <array>
#include <span>
#include <vector>

#include "core/formula/dual_program.h"
#include "core/search/defined_star.h"

namespace dmoscope {

/// Gathered once a visit; for_qualities() then gives the pieces with the star's vertex anywhere. Frame: Plane or Space.
template <class Frame>
class DefinedPieces {
 public:
  using Offset = OffsetIn<Frame, double>;

  /// `scale`: what offsets are in units of, in mesh units.
  void gather(const DefinedStarJudge<Frame>& star, PositionView positions, Index vertex, double scale) {
    judge_ = &star.judge;
    scale_ = scale;
    elements_.clear();
    const Vec3 here = positions[vertex];
    origin_ = coordinates(star.mesh.frame.offset(here, Vec3{}));
    for (const Incidence& at : star.mesh.star(vertex)) {
      Element element{at.element, at.corner, judge_->targets().of(at.element), {}, {}};
      element.pieces = judge_->metric().formula->pieces(star.kinds[at.element], element.target.space);
      const auto corners = star.mesh.corners_of(at.element);
      for (std::size_t i = 0; i < corners.size(); ++i)
        element.corners[i] = coordinates(star.mesh.frame.offset(positions[corners[i]], here));
      elements_.push_back(element);
    }
  }

  /// Calls f with each piece with the vertex at `p`, in the scalar of its coordinates: numbers with derivatives. Of volumes only those that
  /// change with its place: the others say nothing about where it should be.
  template <class P, class F>
  void for_qualities(const P& p, const F& f) const {
    using R = std::remove_cvref_t<decltype(p.x)>;
    thread_local std::vector<R> room;
    const std::array<R, 3> moving = in_mesh_units(p);
    for (const Element& element : elements_)
      for (const FormulaPiece& piece : element.pieces) {
        const bool moves = (piece.corners >> element.moving & 1U) != 0;
        if (!moves && std::is_same_v<Frame, Space>) continue;
        const R value = run_program<R>(
            piece.program,
            [&](const FormulaInput& input) -> R {
              if (input.what == FormulaInput::What::Origin) return R(origin_[input.row]);
              if (input.what != FormulaInput::What::Corner) return R(judge_->given(input, element.id, element.target, 1.0));
              return input.index == element.moving ? moving[input.row] : R(element.corners[input.index][input.row]);
            },
            room);
        f(steeper(value, element.target.steepness));
      }
  }

 private:
  struct Element {
    Index id;
    Index moving;  // the corner that is the star's vertex
    ElementTarget target;
    std::span<const FormulaPiece> pieces;
    std::array<std::array<double, 3>, 8> corners;  // relative to where the vertex stands
  };
  static std::array<double, 3> coordinates(Vec2<double> p) { return {p.x, p.y, 0.0}; }
  static std::array<double, 3> coordinates(Vec3 p) { return {p.x, p.y, p.z}; }
  template <class R>
  [[nodiscard]] std::array<R, 3> in_mesh_units(const Vec2<R>& p) const {
    return {p.x * R(scale_), p.y * R(scale_), R(0.0)};
  }
  template <class R>
  [[nodiscard]] std::array<R, 3> in_mesh_units(const Vec3Of<R>& p) const {
    return {p.x * R(scale_), p.y * R(scale_), p.z * R(scale_)};
  }

  const DefinedJudge* judge_ = nullptr;
  double scale_ = 1.0;
  std::array<double, 3> origin_{};
  std::vector<Element> elements_;
};

}  // namespace dmoscope
