#pragma once
// Judges the elements around a vertex by a formula or a target in one lane, with the bits of core/quality/defined_judge.h.

#include "core/search/defined_star.h"
#include "core/search/mesh_star.h"
#include "core/smooth/reference_visit.h"
#include "gpu/defined/program_code.h"
#include "gpu/listed_star.h"
#include "gpu/task.h"

namespace dmoscope::gpu {

/// Coordinate number `axis` of a vector in the plane or in space.
[[nodiscard]] DMOSCOPE_ANYWHERE double coordinate(Vec2<double> p, std::size_t axis) { return axis == 0 ? p.x : p.y; }
[[nodiscard]] DMOSCOPE_ANYWHERE double coordinate(Vec3 p, std::size_t axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/// Judge of one lane. Frame: Plane or Space. `lane`: its number in the launch.
template <class Frame>
class LaneJudge {
 public:
  DMOSCOPE_LANE LaneJudge(const Task& task, std::size_t lane)
      : task_(task), mesh_(mesh_in<Frame>(task)), positions_(positions_of(task)), lane_(lane) {}

  [[nodiscard]] DMOSCOPE_LANE const MeshView<Frame>& mesh() const { return mesh_; }
  [[nodiscard]] DMOSCOPE_LANE PositionView positions() const { return positions_; }
  template <class Real>
  [[nodiscard]] DMOSCOPE_LANE Registers<Real> registers() const {
    return task_.defined.registers_of<Real>(lane_);
  }

  /// Returns an element's quality: see DefinedJudge::quality(). `at`: gives the place of a vertex.
  template <class At>
  [[nodiscard]] DMOSCOPE_LANE_INLINE DMOSCOPE_LANE double quality(Index element, Index moving, const At& at) const {
    const DefinedTask& defined = task_.defined;
    const bool whole = std::is_same_v<Frame, Plane> || moving == kNoIndex;
    const ProgramCode& code = defined.program(element, whole ? DefinedTask::kWhole : DefinedTask::kElements + moving);
    const auto corners = mesh_.corners_of(element);
    const double value = ProgramRun<double>(code, code.prepared, registers<double>()).run([&](const FormulaInput& input) {
      if (input.what == FormulaInput::What::Corner) return corner(at(corners[input.index]), at(corners[0]), input.row);
      if (input.what == FormulaInput::What::Origin) return origin(at(corners[0]), input.row);
      return defined.number(input, element, 1.0);
    });
    return settled_metric(value, defined.steepness_of_group[defined.search.group_of_element[element]]);
  }
  /// Returns the quality of an element of a star with its vertex at `place`.
  [[nodiscard]] DMOSCOPE_LANE double quality(const Incidence& incidence, Index vertex, Vec3 place) const {
    return quality(incidence.element, incidence.corner, [&](Index v) { return v == vertex ? place : positions_[v]; });
  }
  [[nodiscard]] DMOSCOPE_LANE_INLINE DMOSCOPE_LANE StarState state(Index vertex, Vec3 place) const {
    return star_state_by(mesh_, positions_, vertex, place,
                         [&](const Incidence& at, const auto& /*shape*/) { return quality(at, vertex, place); });
  }

 private:
  [[nodiscard]] DMOSCOPE_LANE double corner(Vec3 p, Vec3 first, std::size_t axis) const {
    if constexpr (std::is_same_v<Frame, Plane>)
      return coordinate(mesh_.frame.offset(p, first), axis);
    else
      return coordinate(p, axis);
  }
  [[nodiscard]] DMOSCOPE_LANE double origin(Vec3 first, std::size_t axis) const {
    if constexpr (std::is_same_v<Frame, Plane>)
      return coordinate(mesh_.frame.project(first), axis);
    else
      return 0.0;
  }

  const Task& task_;
  MeshView<Frame> mesh_;
  PositionView positions_;
  std::size_t lane_;
};

/// The star of a vertex for UntanglingObjective<kDefinedMetric>, read straight from the mesh. Its elements know their quality, as
/// DefinedStar's. An element's C++ type does not tell its kind, so that the code that judges one is there once.
template <class Frame>
class DefinedLaneStar {
 public:
  using Offset = OffsetIn<Frame, double>;

  DMOSCOPE_LANE DefinedLaneStar(const LaneJudge<Frame>& judge, const MeshStar<Frame>& star, Index vertex)
      : judge_(&judge), star_(&star), vertex_(vertex) {}

  /// Element of the star with the vertex at offset `p`.
  struct Placed {
    const DefinedLaneStar* star;
    Incidence incidence;
    Offset p;
    [[nodiscard]] DMOSCOPE_LANE double own_quality() const { return star->quality(incidence, p); }
    /// Calls take(J) for the Jacobian of each corner that changes.
    template <class Take>
    [[nodiscard]] friend DMOSCOPE_LANE formulas::WholeAndAround<double> corner_jacobians(const Placed& placed, Index /*moving*/,
                                                                                         Take take) {
      return placed.star->jacobians(placed.incidence, placed.p, take);
    }
  };
  struct Element {
    const DefinedLaneStar* star;
    Incidence incidence;
    double reference;
    static constexpr Index kMoving = 0;  // unused: the incidence tells the moving corner
    [[nodiscard]] DMOSCOPE_LANE Placed with(Offset p) const { return {star, incidence, p}; }
  };
  struct Triangle : Element {
    static constexpr bool kIsTriangle = true;  // see kPartOfSum
  };

  /// Calls f(element) for each element, list after list, in the order of DefinedStar's view.
  template <bool Others, class F>
  DMOSCOPE_LANE void for_each(F f) const {
    for (unsigned list = 0; list < kLists; ++list)
      for (const Incidence& at : judge_->mesh().star(vertex_)) {
        if (list_of(at) != list) continue;
        const double reference = star_->reference_of(at.element);
        if constexpr (std::is_same_v<Frame, Plane>)
          if (list == 0) {
            f(Triangle{{this, at, reference}});
            continue;
          }
        f(Element{this, at, reference});
      }
  }

  template <class Take>
  [[nodiscard]] DMOSCOPE_LANE formulas::WholeAndAround<double> jacobians(const Incidence& at, Offset p, Take take) const {
    formulas::WholeAndAround<double> found{};
    const auto look = [&]<class E>(const E& element) { found = corner_jacobians(element.with(p), E::kMoving, take); };
    star_->template visit<true>(at, look);
    return found;
  }
  /// The mean of the other corners of the elements: see middle_of().
  [[nodiscard]] DMOSCOPE_LANE Offset middle() const {
    return middle_of<Offset>(ListedStar<Frame>(judge_->mesh(), judge_->positions(), vertex_));
  }
  /// Returns the least metric; of a planar star with an inverted element, its least Jacobian. Objective for stars that are not tangled.
  [[nodiscard]] DMOSCOPE_LANE double operator()(Offset p) const {
    double quality = std::numeric_limits<float>::max(), jacobian = quality;
    for_each<true>([&](const auto& each) {
      const auto placed = each.with(p);
      quality = scalar::min(quality, placed.own_quality());
      jacobian = scalar::min(jacobian, jacobians(placed.incidence, p, [](double) {}).around / each.reference);
    });
    if constexpr (std::is_same_v<Frame, Plane>) return jacobian > 0.0 ? quality : jacobian;
    return quality;
  }

 private:
  static constexpr unsigned kLists = std::is_same_v<Frame, Plane> ? 2 : 5;

  [[nodiscard]] DMOSCOPE_LANE unsigned list_of(const Incidence& at) const {
    const std::size_t corners = judge_->mesh().corners_of(at.element).size();
    if constexpr (std::is_same_v<Frame, Plane>) return corners == 3 ? 0 : 1;
    return corners == 4 ? 0 : corners == 8 ? 1 : corners == 6 ? 2 : at.corner < 4 ? 3 : 4;
  }
  [[nodiscard]] DMOSCOPE_LANE double quality(const Incidence& at, Offset p) const {
    const Vec3 place = judge_->positions()[vertex_] + judge_->mesh().frame.lift(times(p, star_->scale()));
    return judge_->quality(at, vertex_, place);
  }

  const LaneJudge<Frame>* judge_;
  const MeshStar<Frame>* star_;
  Index vertex_;
};

}  // namespace dmoscope::gpu
