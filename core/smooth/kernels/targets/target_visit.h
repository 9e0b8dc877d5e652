#pragma once
// Visit of one vertex, the same as KernelSet::target_lanes makes for many, with the same bits: for a GPU's lanes, and for inspecting it.

#include <array>

#include "core/search/ratio_search.h"
#include "core/smooth/kernels/search_frame.h"
#include "core/smooth/kernels/targets/star_targets.h"
#include "core/smooth/kernels/targets/target_star.h"

namespace dmoscope {

/// Visit by a team of lanes; only the first lane learns the verdict. Task: see FastVisit.
template <bool Crossed, class Task, class Team = Solo>
class TargetVisit {
 public:
  struct Outcome {
    bool ready = false;  // false: the rule for single vertices must judge the star
    visit_rules::Verdict verdict = visit_rules::Verdict::Stay;
    Displacement to{};
  };

  /// Takes the `rank` of a vertex whose star is not Alone, and its `targets`, see append_star_targets().
  DMOSCOPE_ANYWHERE TargetVisit(const Task& task, Index rank, const double* targets, const Team& team = {})
      : task_(task), team_(team), targets_(targets), shape_(task.shapes[rank]), origin_(&task.ranked[rank].x) {}

  template <class Trace = NoTrace>
  [[nodiscard]] DMOSCOPE_ANYWHERE Outcome run(Trace&& trace = {}) const {
    Elements<float> elements;
    const StarView<float> star = gather(elements);
    const Vec2<float> size = box(star);
    const float extent = size.x + size.y;
    std::array<TargetForm<float, Crossed>, target_star::kMaxForms> forms;
    std::size_t count = 0;
    float cap = 0.0F;
    Outcome outcome;
    outcome.ready = target_star::take_forms<Crossed>(
                        star, [this](std::size_t i) { return target<float>(i); }, forms.data(), count, cap) &&
                    extent > visit_rules::kSmallestExtent && extent < task_.frame.largest_extent;
    if (!outcome.ready) return outcome;
    RatioSearch<float, 0, Tables::None, Team, TargetForm<float, Crossed>> rounds(team_);
    const Candidate<float> found = rounds.search({forms.data(), count}, cap, size, task_.parameters.levels, task_.parameters.omega, trace);
    if (team_.lane() != 0) return outcome;
    outcome.to = task_.frame.displace(origin_, found.offset.x, found.offset.y);
    outcome.verdict = judge(outcome.to.step);
    return outcome;
  }

 private:
  template <class R>
  struct Elements {
    std::array<StarTriangle<R>, kMaxFan> triangles;
    std::array<StarQuadrilateral<R>, kMaxQuadrilaterals> quadrilaterals;
  };

  template <class R>
  [[nodiscard]] DMOSCOPE_ANYWHERE CornerTarget<R> target(std::size_t i) const {
    return corner_target<Crossed, R>([&](std::size_t k) { return static_cast<R>(targets_[target_numbers(Crossed) * i + k]); });
  }
  template <class R>
  [[nodiscard]] DMOSCOPE_ANYWHERE Vec2<R> point(std::size_t i) const {
    const double* at = &task_.ranked[task_.others[shape_.first + i]].x;
    const Vec2<double> exact =
        task_.frame.u_axis >= 0 ? task_.frame.template offset<true>(at, origin_) : task_.frame.template offset<false>(at, origin_);
    if constexpr (std::is_same_v<R, double>)
      return exact;
    else
      return {static_cast<float>(exact.x * task_.frame.inverse), static_cast<float>(exact.y * task_.frame.inverse)};
  }
  template <class R>
  [[nodiscard]] DMOSCOPE_ANYWHERE StarView<R> gather(Elements<R>& out) const {
    const std::size_t n = shape_.triangles;
    const bool fan = shape_.kind == StarShape::Kind::Fan;
    for (std::size_t i = 0; i < n; ++i)
      out.triangles[i] = fan ? StarTriangle<R>{point<R>(i), point<R>(i + 1 < n ? i + 1 : 0), R(1)}
                             : StarTriangle<R>{point<R>(2 * i), point<R>(2 * i + 1), R(1)};
    for (std::size_t i = 0, p = 2 * n; i < shape_.quadrilaterals; ++i, p += 3)
      out.quadrilaterals[i] = {point<R>(p), point<R>(p + 1), point<R>(p + 2), R(1)};
    return {out.triangles.data(), n, out.quadrilaterals.data(), shape_.quadrilaterals};
  }
  [[nodiscard]] static DMOSCOPE_ANYWHERE Vec2<float> box(const StarView<float>& star) {
    Vec2<float> low{1e30F, 1e30F}, high{-1e30F, -1e30F};
    const auto add = [&](Vec2<float> p) {
      low = {scalar::min(low.x, p.x), scalar::min(low.y, p.y)};
      high = {scalar::max(high.x, p.x), scalar::max(high.y, p.y)};
    };
    for (const auto& t : star.triangles()) add(t.b), add(t.c);
    for (const auto& q : star.quadrilaterals()) add(q.b), add(q.c), add(q.d);
    return high - low;
  }
  [[nodiscard]] DMOSCOPE_ANYWHERE visit_rules::Verdict judge(Vec2<double> step) const {
    Elements<double> elements;
    const StarView<double> star = gather(elements);
    const auto at = [this](std::size_t i) { return target<double>(i); };
    double room = 0.0;
    for (std::size_t i = 0; i < target_count(); ++i) room = scalar::max(room, target_star::doubt(at(i)));
    return target_star::judge(target_star::quality<Crossed>(star, {0.0, 0.0}, at), target_star::quality<Crossed>(star, step, at), room,
                              step);
  }

  [[nodiscard]] DMOSCOPE_ANYWHERE std::size_t target_count() const {
    return shape_.triangles + kQuadrilateralTargets * shape_.quadrilaterals;
  }

  const Task& task_;
  Team team_;
  const double* targets_;
  StarShape shape_;
  const double* origin_;
};

}  // namespace dmoscope
