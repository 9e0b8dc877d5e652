#pragma once
// The fast search of a volume's star by lanes, with the bits of core/smooth/kernels/volume_kernel_impl.h, which has packs of candidates.

#include <type_traits>

#include "core/search/grid_search.h"
#include "core/smooth/kernels/volume_form.h"
#include "gpu/lane.h"
#include "gpu/listed_star.h"

namespace dmoscope::gpu {

[[nodiscard]] DMOSCOPE_ANYWHERE Vec3Of<float> narrow(Vec3 p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}
[[nodiscard]] DMOSCOPE_ANYWHERE StarTetrahedron<float> narrow(const StarTetrahedron<double>& t) {
  return {narrow(t.b), narrow(t.c), narrow(t.d), 1.0F};
}
[[nodiscard]] DMOSCOPE_ANYWHERE StarTip<float> narrow(const StarTip<double>& t) {
  return {{narrow(t.base[0]), narrow(t.base[1]), narrow(t.base[2]), narrow(t.base[3])}, 1.0F};
}
template <class Narrow, class Wide>
[[nodiscard]] DMOSCOPE_ANYWHERE Narrow narrow_others(const Wide& wide) {
  Narrow result{};
  for (std::size_t i = 0; i < Wide::kOthers; ++i) result.others[i] = narrow(wide.others[i]);
  result.reference = 1.0F;
  return result;
}
[[nodiscard]] DMOSCOPE_ANYWHERE StarHexahedron<float> narrow(const StarHexahedron<double>& h) {
  return narrow_others<StarHexahedron<float>>(h);
}
[[nodiscard]] DMOSCOPE_ANYWHERE StarWedge<float> narrow(const StarWedge<double>& w) { return narrow_others<StarWedge<float>>(w); }
[[nodiscard]] DMOSCOPE_ANYWHERE StarPyramid<float> narrow(const StarPyramid<double>& p) { return narrow_others<StarPyramid<float>>(p); }

/// Capacity of a team's memory in common, in elements and bytes: large enough for nearly all stars of tetrahedra, and of eight hexahedra,
/// and too small to limit the number of teams that work at once.
inline constexpr std::size_t kStaged = 32, kStageBytes = kStaged * sizeof(StarTetrahedron<float>);

/// Team with memory in common: it has kScratchBytes, scratch(), the same for all its lanes, and meet(), after which each lane reads what
/// the others wrote there.
template <class Team>
concept HasScratch = requires(const Team& team) {
  team.scratch();
};

/// Some candidates of a column, which are ranked at a time, so that an element is read once for all of them; and the least rank of the star
/// with its vertex at each.
struct SomeCandidates {
  static constexpr int kCount = 4;
  Vec3Of<float> at[kCount];
  float worth[kCount];
};

/// The search by the lanes of a team, which share the columns of the grid. Ranks: rank(SomeCandidates&) finds the candidates' ranks.
template <class Ranks, class Team>
class VolumeLevels {
 public:
  DMOSCOPE_LANE_INLINE DMOSCOPE_ANYWHERE VolumeLevels(const Ranks& ranks, Vec3Of<float> box, const SearchParameters& parameters,
                                                      const Team& team)
      : ranks_(ranks), box_(box), parameters_(parameters), team_(team) {}

  [[nodiscard]] DMOSCOPE_LANE_INLINE DMOSCOPE_ANYWHERE VolumeFound run() const {
    Found best = rank({});
    if (!(best.objective > volumes::kLeastRank)) return {};
    double omega = parameters_.omega;
    for (int level = 0; level < parameters_.levels; ++level) {
      best = search(best, static_cast<float>(omega));
      omega *= 2.0 / (parameters_.grid_points - 1);
    }
    return {true, best.offset};
  }

 private:
  using Point = Vec3Of<float>;
  using Found = Candidate<float, Point>;
  static constexpr int kAtOnce = SomeCandidates::kCount;

  DMOSCOPE_ANYWHERE Found rank(Point p) const {
    SomeCandidates some;
    DMOSCOPE_UNROLL
    for (Point& at : some.at) at = p;
    ranks_.rank(some);
    return {p, some.worth[0]};
  }
  /// Searches one level, around the best candidate so far: among equals the candidate of lowest index wins.
  DMOSCOPE_ANYWHERE Found search(Found best, float omega) const {
    const CandidateGrid<float, Point> grid{best.offset, times(box_, omega), parameters_.grid_points};
    const int n = grid.points;
    int index = -1;
    for (int column = static_cast<int>(team_.lane()); column < n * n; column += static_cast<int>(Team::kSize)) {
      for (int k = 0; k < n; k += kAtOnce) {
        SomeCandidates some;
        DMOSCOPE_UNROLL
        for (int i = 0; i < kAtOnce; ++i) some.at[i] = grid.at(column / n, column % n, k + i < n ? k + i : n - 1);  // repeats the last
        ranks_.rank(some);
        DMOSCOPE_UNROLL
        for (int i = 0; i < kAtOnce; ++i) {
          if (!(some.worth[i] > best.objective)) continue;
          best = {some.at[i], some.worth[i]};
          index = column * n + k + i;
        }
      }
    }
    if constexpr (Team::kSize > 1) best = best_of_team(team_, best, index);
    return best;
  }

  const Ranks& ranks_;
  Point box_;
  const SearchParameters& parameters_;
  const Team& team_;
};

/// Ranks by a built-in metric. In a team with memory in common the lanes share the elements: each is read in double and narrowed once a
/// search.
template <Metric M, class Team>
class VolumeRankSearch {
 public:
  DMOSCOPE_LANE_INLINE DMOSCOPE_ANYWHERE VolumeRankSearch(const MeshStar<Space>& star, const SearchParameters& parameters, const Team& team)
      : star_(star), parameters_(parameters), team_(team) {
    if constexpr (HasScratch<Team>) stage();
  }

  [[nodiscard]] DMOSCOPE_LANE_INLINE DMOSCOPE_ANYWHERE VolumeFound run() const {
    return VolumeLevels<VolumeRankSearch, Team>(*this, narrow(star_.box()), parameters_, team_).run();
  }

  DMOSCOPE_ANYWHERE void rank(SomeCandidates& some) const {
    DMOSCOPE_UNROLL
    for (float& worth : some.worth) worth = std::numeric_limits<float>::max();
    if constexpr (HasScratch<Team>) {
      for (unsigned i = 0; i < staged_; ++i) lower(some, stage_[i]);
      if (staged_ > 0) return;
    }
    star_.template for_each<kCorners>([&some](const auto& element) { lower(some, narrow(element)); });
  }

 private:
  using Point = Vec3Of<float>;
  using Form = volumes::MeanRatioForm<float>;
  static constexpr bool kCorners = formulas::kDefinedForCorners<M>;
  static constexpr int kAtOnce = SomeCandidates::kCount;
  /// The data of an element that all candidates share: a form for each corner by the mean ratio; by other metrics the element, if it is a
  /// tetrahedron.
  using Staged = std::conditional_t<M == Metric::MeanRatio, Form, StarTetrahedron<float>>;
  static_assert(sizeof(Staged) * kStaged <= kStageBytes);

  /// Puts the star's elements into the team's memory, in their order, each by one lane; none if there is no room for all.
  DMOSCOPE_LANE_INLINE DMOSCOPE_ANYWHERE void stage() {
    static_assert(Team::kScratchBytes >= kStageBytes);
    stage_ = static_cast<Staged*>(team_.scratch());
    unsigned element = 0;
    bool has_room = true;
    star_.template for_each<kCorners>([&](const auto& wide) {
      const bool is_mine = element++ % Team::kSize == team_.lane();
      has_room = put(wide, is_mine) && has_room;
    });
    if (!has_room) staged_ = 0;
    team_.meet();
  }
  DMOSCOPE_ANYWHERE bool put(const StarTetrahedron<double>& wide, bool is_mine) {
    const unsigned at = staged_++;
    if (at >= kStaged) return false;
    if (!is_mine) return true;
    const StarTetrahedron<float> t = narrow(wide);
    if constexpr (M == Metric::MeanRatio)
      stage_[at] = volumes::tetrahedron_form(t.b, t.c, t.d);
    else
      stage_[at] = t;
    return true;
  }
  template <class Element>
  DMOSCOPE_ANYWHERE bool put(const Element& wide, bool is_mine) {
    if constexpr (M != Metric::MeanRatio) return false;
    const auto element = narrow(wide);
    const auto for_forms = [&](const auto& f) { volumes::for_corner_forms(element.with(Point{}), element.kMoving, f); };
    if constexpr (M == Metric::MeanRatio) {
      if (is_mine)
        for_forms([this](const Form& form) {
          if (staged_ < kStaged) stage_[staged_] = form;
          ++staged_;
        });
      else
        for_forms([this](const Form& /*form*/) { ++staged_; });  // counts without computing
    }
    return staged_ <= kStaged;
  }
  static DMOSCOPE_ANYWHERE void lower(SomeCandidates& some, const StarTetrahedron<float>& t) {
    if constexpr (M == Metric::MeanRatio) {
      lower(some, volumes::tetrahedron_form(t.b, t.c, t.d));
    } else {
      DMOSCOPE_UNROLL
      for (int i = 0; i < kAtOnce; ++i) some.worth[i] = scalar::min(some.worth[i], formulas::rank<M>(t.with(some.at[i])));
    }
  }
  template <class Element>
  static DMOSCOPE_ANYWHERE void lower(SomeCandidates& some, const Element& element) {
    if constexpr (M == Metric::MeanRatio) {
      volumes::for_corner_forms(element.with(Point{}), element.kMoving, [&some](const Form& form) { lower(some, form); });
    } else {
      DMOSCOPE_UNROLL
      for (int i = 0; i < kAtOnce; ++i)
        some.worth[i] = scalar::min(some.worth[i], formulas::rank_around<M>(element.with(some.at[i]), element.kMoving));
    }
  }
  static DMOSCOPE_ANYWHERE void lower(SomeCandidates& some, const Form& form) {
    DMOSCOPE_UNROLL
    for (int i = 0; i < kAtOnce; ++i) {
      const Point p = some.at[i];
      some.worth[i] = scalar::min(some.worth[i], volumes::rank_of(form, p, dot(p, p)));
    }
  }

  const MeshStar<Space>& star_;
  const SearchParameters& parameters_;
  const Team& team_;
  Staged* stage_ = nullptr;  // the team's memory, and how much of it is used
  unsigned staged_ = 0;
};

}  // namespace dmoscope::gpu
