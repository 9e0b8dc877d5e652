#pragma once
// The objective for a star that has inverted elements, and the conditions that a place must meet in it (promise 1).
//
// The least Jacobian alone is not enough: it stalls where several corners hold each other, and in a hexahedron that is nearly everywhere (a
// cube of 125, 36 of them inverted, ended with 3). So it must not fall, and a mean over all corners rises, in which a corner that is good
// enough gains nothing more. Nor may a sound element become inverted, or a metric fall below the worst of the whole mesh: otherwise,
// if a fixed vertex makes untangling impossible, neighbours would pass the damage on for ever. For the same reason attempts are limited in
// time: between them the sound elements of a star are raised as if the inverted ones were not there. Before all this a repair brings back
// vertices that are far from their star: their neighbours must not follow them.

#include <cstdint>
#include <limits>

#include "core/base/host_device.h"
#include "core/quality/formulas.h"
#include "core/quality/validity.h"
#include "core/search/grid_search.h"

namespace dmoscope {

/// How the visits of an iteration treat stars with inverted elements.
struct Untangling {
  /// Whether only vertices of inverted elements move, and only if that makes all of their star sound, with a least metric of at least
  /// kRepaired.
  bool repair = false;
  /// Whether sound elements of such a star may get worse, though not inverted, for the sake of the inverted ones; else the sound ones are
  /// raised and no inverted one may get worse.
  bool attempt = true;
  /// The least metric of the movable elements at the begin of the iteration: no element may fall below it, or below the least of its star.
  double floor = -std::numeric_limits<double>::infinity();
  static constexpr double kRepaired = 0.2;
  /// Whether elements that are inverted inside alone (see validity.h) count as inverted: in an attempt. A mesh without inverted elements is
  /// not searched for such.
  [[nodiscard]] DMOSCOPE_ANYWHERE bool looks_inside() const noexcept {
    return attempt && !repair && floor > -std::numeric_limits<double>::infinity();
  }
  friend bool operator==(const Untangling&, const Untangling&) = default;
};

/// The mean of min(J / reference, kEnough) over the corners of a star that change with its vertex. A reference is the Jacobian of an ideal
/// element, so that J / reference is about 1 in a good one.
class UntanglingMean {
 public:
  static constexpr double kEnough = 0.2;

  DMOSCOPE_ANYWHERE void add(double jacobian, double reference) {
    sum_ += scalar::min(jacobian / reference, kEnough);
    ++count_;
  }
  /// Adds the corners of other elements.
  DMOSCOPE_ANYWHERE void add(const UntanglingMean& other) {
    sum_ += other.sum_;
    count_ += other.count_;
  }
  [[nodiscard]] DMOSCOPE_ANYWHERE double value() const { return count_ > 0 ? sum_ / count_ : 0.0; }

 private:
  double sum_ = 0.0;
  int count_ = 0;
};

/// Part of a star's sums that an element belongs to: 0 for triangles, 1 for quadrilaterals. A planar star may come in the order of the
/// mesh's elements or triangles first; sums over triangles and quadrilaterals apart have the same bits in both.
template <class Element>
inline constexpr unsigned kPartOfSum = requires {
  Element::kIsTriangle;
}
? 0 : 1;

/// Smallest corner Jacobians of an element: of all its corners, and of those that change with corner `moving`. Calls take(J) with each of
/// the latter (with the least of a planar element).
template <class V, class Take>
[[nodiscard]] DMOSCOPE_ANYWHERE formulas::WholeAndAround<double> corner_jacobians(const formulas::Triangle<V>& t, Index /*moving*/,
                                                                                  Take take) {
  take(t.twice_area);
  return {t.twice_area, t.twice_area};
}
template <class V, class Take>
[[nodiscard]] DMOSCOPE_ANYWHERE formulas::WholeAndAround<double> corner_jacobians(const formulas::Quadrilateral<V>& q, Index /*moving*/,
                                                                                  Take take) {
  const double least = formulas::smallest_jacobian(q);
  take(least);
  return {least, least};
}
template <class V, class Take>
[[nodiscard]] DMOSCOPE_ANYWHERE formulas::WholeAndAround<double> corner_jacobians(const formulas::Tetrahedron<V>& t, Index /*moving*/,
                                                                                  Take take) {
  take(t.six_volume);
  return {t.six_volume, t.six_volume};
}
template <class V, class Ideal, std::size_t N, class Corners, class Take>
[[nodiscard]] DMOSCOPE_ANYWHERE formulas::WholeAndAround<double> corner_jacobians(const formulas::CorneredSolid<V, Ideal, N, Corners>& s,
                                                                                  Index moving, Take take) {
  (void)s.least_around(moving, [&take](V, V, V, double jacobian) {
    take(jacobian);
    return jacobian;
  });
  return s.least_whole_and_around(moving, [](V, V, V, double jacobian) { return jacobian; });
}

/// The mean of the other corners of a star's elements: a place for a vertex that lies far from its star, which no grid around it reaches.
template <class Point>
class MeanOfCorners {
 public:
  template <class Real>
  DMOSCOPE_ANYWHERE void add(const StarTriangle<Real>& t) {
    add(t.b), add(t.c);
  }
  template <class Element>
  DMOSCOPE_ANYWHERE void add(const Element& element) requires requires {
    element.d;
  }
  { add(element.b), add(element.c), add(element.d); }
  template <class Element>
  DMOSCOPE_ANYWHERE void add(const Element& element) requires requires {
    element.others;
  }
  {
    for (const Point& p : element.others) add(p);
  }
  template <class Element>
  DMOSCOPE_ANYWHERE void add(const Element& element) requires requires {
    element.base;
  }
  {
    for (const Point& p : element.base) add(p);
  }
  [[nodiscard]] DMOSCOPE_ANYWHERE Point value() const { return count_ > 0.0 ? times(sum_, 1.0 / count_) : Point{}; }
  /// Adds the corners of other elements.
  DMOSCOPE_ANYWHERE void add(const MeanOfCorners& other) {
    sum_ = sum_ + other.sum_;
    count_ += other.count_;
  }

 private:
  DMOSCOPE_ANYWHERE void add(const Point& p) {
    sum_ = sum_ + p;
    count_ += 1.0;
  }
  Point sum_{};
  double count_ = 0.0;
};

/// Start of the search for a better place of a tangled star's vertex.
template <class Point, class StarT>
[[nodiscard]] DMOSCOPE_ANYWHERE Point middle_of(const StarT& star) {
  MeanOfCorners<Point> parts[2];
  star.template for_each<true>([&parts]<class Element>(const Element& each) { parts[kPartOfSum<Element>].add(each); });
  parts[0].add(parts[1]);
  return parts[0].value();
}

/// Inverted elements of a star with its vertex in the present place: the first 64 are remembered, others are evaluated again.
class InvertedSet {
 public:
  DMOSCOPE_ANYWHERE void add(int element, bool inverted) {
    if (inverted && element < kKept) bits_ |= std::uint64_t{1} << static_cast<unsigned>(element);
  }
  [[nodiscard]] static DMOSCOPE_ANYWHERE bool keeps(int element) { return element < kKept; }
  [[nodiscard]] DMOSCOPE_ANYWHERE bool has(int element) const { return (bits_ >> static_cast<unsigned>(element) & 1U) != 0; }

 private:
  static constexpr int kKept = 64;
  std::uint64_t bits_ = 0;
};

/// The worth of a star with its vertex at a place. If no corner that changes with the vertex is inverted, it is the least metric, which is
/// positive. Else in a repair: the least Jacobian, mapped into (-1, 0]; for simplices it has a single maximum. Else at an allowed place: in
/// an attempt the mean, mapped into (-1, 0]; without one (least metric of the sound elements - 1) / 2, less the number of inverted ones. At
/// other places: kForbidden. Allowed are places that leave sound elements sound; in an attempt if there is no lesser least Jacobian and no
/// metric below the floor, without one if the least metric of all is no lower. If elements are inverted only inside, and the rule looks
/// there: the least metric, less 2 for each of them; allowed are places without inverted corners and without a metric below the floor.
template <Metric M, class StarT, class Point>
class UntanglingObjective {
 public:
  static constexpr double kForbidden = -1e9;

  DMOSCOPE_INLINE DMOSCOPE_ANYWHERE UntanglingObjective(StarT star, const Untangling& rule) : star_(star), rule_(rule) {
    int element = 0;
    star_.template for_each<kOthers>([&](const auto& each) {
      const auto shape = each.with(Point{});
      const auto least = corner_jacobians(shape, each.kMoving, [](double) {});
      const double quality = formulas::metric_around<M>(shape, each.kMoving);
      inverted_.add(element++, least.whole <= 0.0);
      jacobian_ = scalar::min(jacobian_, least.around / each.reference);
      quality_ = scalar::min(quality_, quality);
      if constexpr (kHasInside<decltype(shape)>)
        if (rule_.looks_inside() && !inside_) inside_ = least.whole > 0.0 && !(least_jacobian(shape) > 0.0);
    });
    inside_ = inside_ && !is_tangled_at_corners();
    floor_ = rule_.attempt ? scalar::min(quality_, rule_.floor) : quality_;
  }

  /// Whether an element is inverted with the vertex in its present place: by a corner that changes with it, or inside if the rule looks
  /// there.
  [[nodiscard]] DMOSCOPE_ANYWHERE bool tangled() const { return inside_ || is_tangled_at_corners(); }

  [[nodiscard]] DMOSCOPE_INLINE DMOSCOPE_ANYWHERE double operator()(Point p) const {
    if (inside_) return inside(p);
    const Jacobians found = jacobians(p);
    const bool sound = found.least > 0.0;
    if (rule_.repair && !sound) return bounded(found.least);
    if (!found.allowed) return kForbidden;
    const Metrics metrics = judge(p, sound);
    if (rule_.repair) return scalar::max(metrics.least, 0.0);
    if (!metrics.allowed) return kForbidden;
    if (sound && metrics.least > 0.0) return metrics.least;
    if (!rule_.attempt) return 0.5 * (scalar::min(metrics.sound, 1.0) - 1.0) - found.count;
    return bounded(scalar::min(found.mean - UntanglingMean::kEnough, 0.0));
  }

 private:
  static constexpr bool kOthers = formulas::kDefinedForOthers<M, Point>;
  static constexpr double kMost = std::numeric_limits<double>::max();
  /// Maps (-infinity, 0] to (-1, 0].
  static DMOSCOPE_ANYWHERE double bounded(double a) { return a / (1.0 - a); }

  [[nodiscard]] DMOSCOPE_ANYWHERE bool is_tangled_at_corners() const { return !(jacobian_ > 0.0 && quality_ > 0.0); }
  [[nodiscard]] DMOSCOPE_INLINE DMOSCOPE_ANYWHERE double inside(Point p) const {
    double least = kMost;
    int inverted = 0;
    bool allowed = true;
    star_.template for_each<kOthers>([&](const auto& each) {
      if (!allowed) return;
      const auto shape = each.with(p);
      const auto jacobian = corner_jacobians(shape, each.kMoving, [](double) {});
      least = scalar::min(least, formulas::metric_around<M>(shape, each.kMoving));
      allowed = jacobian.around > 0.0 && !(least < floor_);
      if constexpr (kHasInside<decltype(shape)>)
        if (allowed && !(least_jacobian(shape) > 0.0)) ++inverted;
    });
    return allowed ? least - 2.0 * inverted : kForbidden;
  }

  /// Findings from the Jacobians of a star with its vertex at a place.
  struct Jacobians {
    double least = kMost, mean = 0.0;  // relative to their references
    int count = 0;                     // number of inverted elements
    bool allowed = true;               // whether the Jacobians allow the place; if not, nothing else is known
  };
  [[nodiscard]] DMOSCOPE_INLINE DMOSCOPE_ANYWHERE Jacobians jacobians(Point p) const {
    Jacobians found;
    UntanglingMean mean[2];
    int element = 0;
    star_.template for_each<kOthers>([&]<class Element>(const Element& each) {
      const int i = element++;
      if (!found.allowed) return;
      const auto jacobian =
          corner_jacobians(each.with(p), each.kMoving, [&](double j) { mean[kPartOfSum<Element>].add(j, each.reference); });
      const double relative = jacobian.around / each.reference;
      const bool is_inverted = jacobian.whole <= 0.0;
      found.count += is_inverted ? 1 : 0;
      found.least = scalar::min(found.least, relative);
      if (rule_.repair) return;
      found.allowed = (!rule_.attempt || relative >= scalar::min(jacobian_, 0.0)) && (!is_inverted || was_inverted(i, each));
    });
    mean[0].add(mean[1]);
    found.mean = mean[0].value();
    return found;
  }

  /// Findings from the metrics. They cost most: in an attempt those of sound elements are needed only if all are sound, or if the metric's
  /// sign does not tell which are.
  struct Metrics {
    double least = kMost, sound = kMost;  // least of all that were needed, and of the sound elements
    bool allowed = true;
  };
  [[nodiscard]] DMOSCOPE_INLINE DMOSCOPE_ANYWHERE Metrics judge(Point p, bool all) const {
    Metrics found;
    constexpr bool kTells = formulas::kSignTellsInversion<M, Point>;
    const bool of_all = all || !rule_.attempt || !kTells;
    const bool known = all && rule_.attempt && kTells;  // no corner around is inverted, and the caller needs no more
    star_.template for_each<kOthers>([&](const auto& each) {
      if (!found.allowed) return;
      const auto shape = each.with(p);
      formulas::WholeAndAround<double> jacobian{1.0, 1.0};
      if (!known) jacobian = corner_jacobians(shape, each.kMoving, [](double) {});
      const bool doubtful = jacobian.around <= 0.0 || !kTells;
      if (!of_all && !doubtful) return;
      const double value = formulas::metric_around<M>(shape, each.kMoving);
      found.least = scalar::min(found.least, value);
      if (!(jacobian.whole <= 0.0)) found.sound = scalar::min(found.sound, value);
      if (!rule_.repair && (doubtful || !rule_.attempt)) found.allowed = !(value < floor_);
    });
    return found;
  }

  template <class Element>
  [[nodiscard]] DMOSCOPE_ANYWHERE bool was_inverted(int i, const Element& each) const {
    if (InvertedSet::keeps(i)) return inverted_.has(i);
    return corner_jacobians(each.with(Point{}), each.kMoving, [](double) {}).whole <= 0.0;
  }

  StarT star_;
  Untangling rule_;
  InvertedSet inverted_;
  double jacobian_ = kMost, quality_ = kMost;  // least values with the vertex in its present place, the Jacobian over its reference
  double floor_ = 0.0;
  bool inside_ = false;
};

}  // namespace dmoscope
