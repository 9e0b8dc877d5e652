#pragma once
// Visit of one vertex by the fast search: the same as the processor's lanes (core/smooth/kernels/lane_kernel_impl.h), with the same bits,
// for one lane of a GPU or a team of them, and for inspecting a visit.

#include <array>

#include "core/base/host_device.h"
#include "core/search/grid_search.h"
#include "core/search/ratio_search.h"
#include "core/smooth/kernels/search_frame.h"
#include "core/smooth/kernels/star_table.h"
#include "core/smooth/kernels/visit_rules.h"

namespace dmoscope {

/// Closed fan of N triangles around a vertex, each point known once, in registers.
template <class R, std::size_t N>
struct FanStar {
  std::array<Vec2<R>, N> ring;

  template <bool Quadrilaterals, class F>
  DMOSCOPE_ANYWHERE void for_each(F f) const {
    DMOSCOPE_UNROLL
    for (std::size_t i = 0; i < N; ++i) f(StarTriangle<R>{ring[i], ring[i + 1 < N ? i + 1 : 0], R(1)});
  }
};

/// Stars that a kernel is made for: the closed fans of the sizes that nearly all triangle meshes have, whose search runs in registers, 4 to
/// 6 triangles or 7 and 8, which take more of them; all others that have a place in lanes; or all three.
enum class Stars { SmallFans, LargeFans, Others, All };

/// Kind of a star, one of the first three.
template <Metric M>
[[nodiscard]] DMOSCOPE_ANYWHERE Stars kind_of_star(const StarShape& shape, const SearchParameters& parameters) {
  const bool is_fan = kIsRatio<M> && shape.kind == StarShape::Kind::Fan && shape.triangles >= 4 && shape.triangles <= 8;
  if (!is_fan || parameters.grid_points != 8) return Stars::Others;
  return shape.triangles <= 6 ? Stars::SmallFans : Stars::LargeFans;
}

/// Visit of one vertex by a team of lanes; only the first lane learns the verdict. Task: anything with the `shapes`, `others` and `ranked`
/// positions (Vec3) of a StarTable, a `frame` and search `parameters`.
template <Metric M, class Team, Stars S, class Task>
class FastVisit {
 public:
  using Verdict = visit_rules::Verdict;
  struct Outcome {
    bool ready = false;  // false: the exact visit must judge the star
    Verdict verdict = Verdict::Stay;
    Displacement to{};
  };

  /// Takes the `rank` of a vertex whose star is not Alone.
  DMOSCOPE_ANYWHERE FastVisit(const Task& task, Index rank, const Team& team)
      : task_(task), team_(team), shape_(task.shapes[rank]), others_(task.others + shape_.first), origin_(&task.ranked[rank].x) {}

  template <class Trace = NoTrace>
  [[nodiscard]] DMOSCOPE_ANYWHERE Outcome run(Trace&& trace = {}) const {
    if constexpr (kIsRatio<M> && S != Stars::Others) {
      const Stars stars = S == Stars::All ? kind_of_star<M>(shape_, task_.parameters) : S;
      if constexpr (S != Stars::LargeFans)
        if (stars == Stars::SmallFans) return visit_small_fan(trace);
      if constexpr (S != Stars::SmallFans)
        if (stars == Stars::LargeFans) {
          if (shape_.triangles == 7) return visit_fan<7>(trace);
          // Leaves fans of 8 to single lanes: those of a team, which keep more in registers, would spill.
          if constexpr (Team::kSize == 1) return visit_fan<8>(trace);
        }
    }
    if constexpr (S == Stars::Others || S == Stars::All) return visit_any(trace);
    return {};
  }

 private:
  static constexpr std::size_t kPoints = 8;  // same as in RatioSearch
  static constexpr bool kQuadrilaterals = formulas::kDefinedForQuadrilaterals<M, Vec2<float>>;
  static constexpr bool kBlind = visit_rules::kBlind<M, Vec2<float>>;

  [[nodiscard]] DMOSCOPE_ANYWHERE Vec2<double> exact_point(std::size_t i) const {
    const double* at = &task_.ranked[others_[i]].x;
    return task_.frame.u_axis >= 0 ? task_.frame.template offset<true>(at, origin_) : task_.frame.template offset<false>(at, origin_);
  }
  [[nodiscard]] DMOSCOPE_ANYWHERE Vec2<float> point(std::size_t i) const {
    const Vec2<double> exact = exact_point(i);
    return {static_cast<float>(exact.x * task_.frame.inverse), static_cast<float>(exact.y * task_.frame.inverse)};
  }

  /// Bounding box of points that are added one by one.
  class Box {
   public:
    DMOSCOPE_ANYWHERE explicit Box(Vec2<float> first) : low_(first), high_(first) {}
    DMOSCOPE_ANYWHERE void add(Vec2<float> p) {
      low_ = {scalar::min(low_.x, p.x), scalar::min(low_.y, p.y)};
      high_ = {scalar::max(high_.x, p.x), scalar::max(high_.y, p.y)};
    }
    [[nodiscard]] DMOSCOPE_ANYWHERE Vec2<float> size() const { return high_ - low_; }

   private:
    Vec2<float> low_, high_;
  };

  template <class Trace>
  [[nodiscard]] DMOSCOPE_ANYWHERE Outcome visit_small_fan(Trace& trace) const {
    if (shape_.triangles == 6) return visit_fan<6>(trace);
    return shape_.triangles == 5 ? visit_fan<5>(trace) : visit_fan<4>(trace);
  }

  template <std::size_t N, class Trace>
  [[nodiscard]] DMOSCOPE_ANYWHERE Outcome visit_fan(Trace& trace) const {
    FanStar<float, N> star;
    DMOSCOPE_UNROLL
    for (std::size_t i = 0; i < N; ++i) star.ring[i] = point(i);
    Box box(star.ring[0]);
    DMOSCOPE_UNROLL
    for (std::size_t i = 1; i < N; ++i) box.add(star.ring[i]);
    return decide(star, box.size(), [&](Vec2<float> size) {
      RatioForm<float> forms[N];
      DMOSCOPE_UNROLL
      for (std::size_t i = 0; i < N; ++i)
        triangle_form(StarTriangle<float>{star.ring[i], star.ring[i + 1 < N ? i + 1 : 0], 1.0F}, forms[i]);
      RatioSearch<float, N, Tables::Rows, Team> rounds(team_);
      return rounds.search(std::span<RatioForm<float>, N>(forms), 1e30F, size, task_.parameters.levels, task_.parameters.omega, trace);
    });
  }

  /// Visits a star of any kind that has a place in lanes.
  template <class Trace>
  [[nodiscard]] DMOSCOPE_ANYWHERE Outcome visit_any(Trace& trace) const {
    std::array<StarTriangle<float>, kMaxFan> triangles;
    std::array<StarQuadrilateral<float>, kQuadrilaterals ? kMaxQuadrilaterals : 1> quadrilaterals;
    const Vec2<float> first = point(0);
    Box box(first);
    const auto at = [&](std::size_t i) {
      const Vec2<float> p = point(i);
      box.add(p);
      return p;
    };
    const std::size_t n = shape_.triangles;
    if (shape_.kind == StarShape::Kind::Fan) {
      Vec2<float> b = first;
      for (std::size_t i = 0; i < n; ++i) {
        const Vec2<float> c = i + 1 < n ? at(i + 1) : first;
        triangles[i] = {b, c, 1.0F};
        b = c;
      }
    } else {
      for (std::size_t i = 0; i < n; ++i) triangles[i] = {at(2 * i), at(2 * i + 1), 1.0F};
      if constexpr (kQuadrilaterals)
        for (std::size_t i = 0; i < shape_.quadrilaterals; ++i) {
          const std::size_t p = 2 * n + 3 * i;
          quadrilaterals[i] = {at(p), at(p + 1), at(p + 2), 1.0F};
        }
    }
    const StarView<float> star(triangles.data(), n, quadrilaterals.data(), kQuadrilaterals ? shape_.quadrilaterals : 0);
    return decide(star, box.size(), [&](Vec2<float> size) {
      if constexpr (kIsRatio<M>)
        if (task_.parameters.grid_points == static_cast<int>(kPoints)) return search_by_rounds(star, size, trace);
      return grid_search<float>(objective(star), size, task_.parameters, trace, team_);
    });
  }

  template <class Trace>
  [[nodiscard]] DMOSCOPE_ANYWHERE Candidate<float> search_by_rounds(const StarView<float>& star, Vec2<float> size, Trace& trace) const {
    using Rounds = RatioSearch<float, 0, Tables::None, Team>;
    std::array<RatioForm<float>, Rounds::kMaxForms> forms;
    std::size_t count = 0;
    float cap = 1e30F;
    for (const StarTriangle<float>& t : star.triangles()) triangle_form(t, forms[count++]);
    if constexpr (kQuadrilaterals) {
      for (const StarQuadrilateral<float>& q : star.quadrilaterals()) {
        cap = scalar::min(cap, quadrilateral_forms<M>(q, forms.data() + count));
        count += kQuadrilateralForms<M>;
      }
    }
    Rounds rounds(team_);
    return rounds.search({forms.data(), count}, cap, size, task_.parameters.levels, task_.parameters.omega, trace);
  }

  template <class StarT>
  [[nodiscard]] static DMOSCOPE_ANYWHERE auto objective(const StarT& star) {
    return Objective<M, false, float, Value::Rank, StarT>(star);
  }

  /// Searches a star and judges the winner. search(size): the best candidate of a grid over a box of that size.
  template <class StarT, class Search>
  [[nodiscard]] DMOSCOPE_ANYWHERE Outcome decide(const StarT& star, Vec2<float> size, Search search) const {
    const float extent = size.x + size.y;
    Outcome outcome;
    outcome.ready = objective(star)({0.0F, 0.0F}) > visit_rules::kLeastRank && extent > visit_rules::kSmallestExtent &&
                    extent < task_.frame.largest_extent;
    if constexpr (kBlind)
      if (shape_.quadrilaterals > 0) outcome.ready = outcome.ready && corners(star) > visit_rules::kLeastCorner * extent * extent;
    if (!outcome.ready) return outcome;
    const Candidate<float> found = search(size);
    if (team_.lane() != 0 || (found.offset.x == 0.0F && found.offset.y == 0.0F)) return outcome;
    outcome.to = task_.frame.displace(origin_, found.offset.x, found.offset.y);
    outcome.verdict = judge(outcome.to.step, extent);
    return outcome;
  }

  [[nodiscard]] static DMOSCOPE_ANYWHERE float corners(const StarView<float>& star) {
    return visit_rules::smallest_corner(star, {0.0F, 0.0F});
  }
  template <std::size_t N>
  [[nodiscard]] static DMOSCOPE_ANYWHERE float corners(const FanStar<float, N>& /*star*/) {
    return 1e30F;
  }

  /// Judges a step in double, at the very position that would be stored.
  [[nodiscard]] DMOSCOPE_ANYWHERE Verdict judge(Vec2<double> step, float extent) const {
    Worth<M, false, double, Value::Rank, Vec2<double>> before, after;
    const auto take = [&](const auto& element) {
      before.take(element, {0.0, 0.0});
      after.take(element, step);
    };
    [[maybe_unused]] double corner = 1e30;
    const std::size_t n = shape_.triangles;
    if (shape_.kind == StarShape::Kind::Fan) {
      const Vec2<double> first = exact_point(0);
      Vec2<double> b = first;
      for (std::size_t i = 0; i < n; ++i) {
        const Vec2<double> c = i + 1 < n ? exact_point(i + 1) : first;
        take(StarTriangle<double>{b, c, 1.0});
        b = c;
      }
    } else {
      for (std::size_t i = 0; i < n; ++i) take(StarTriangle<double>{exact_point(2 * i), exact_point(2 * i + 1), 1.0});
      if constexpr (kQuadrilaterals)
        for (std::size_t i = 0; i < shape_.quadrilaterals; ++i) {
          const std::size_t p = 2 * n + 3 * i;
          const StarQuadrilateral<double> q{exact_point(p), exact_point(p + 1), exact_point(p + 2), 1.0};
          take(q);
          if constexpr (kBlind) corner = scalar::min(corner, visit_rules::smallest_corner(StarView<double>(nullptr, 0, &q, 1), step));
        }
    }
    bool sound = true;
    if constexpr (kBlind)
      sound = shape_.quadrilaterals == 0 ||
              corner * (task_.frame.inverse * task_.frame.inverse) > visit_rules::kSoundCorner * static_cast<double>(extent * extent);
    return visit_rules::judge<M>(before.value(), after.value(), step, sound);
  }

  const Task& task_;
  Team team_;
  StarShape shape_;
  const Index* others_;
  const double* origin_;
};

}  // namespace dmoscope
