#pragma once
// What is maximised in a volume's star that has inverted elements. The least Jacobian alone does not do: it stalls where several corners
// hold each other, and in a hexahedron that is not far from everywhere (a cube of 125, 36 of them inverted, ended with 3). So it must not
// fall, and what rises is a mean over all corners, in which those that are good enough count no more.

#include <limits>

#include "core/base/anywhere.h"
#include "core/quality/solids.h"
#include "core/search/grid_search.h"

namespace dmoscope {

/// The mean of min(J / reference, kEnough) over the corners of a star that change with its vertex. A reference is the Jacobian of an ideal
/// element, so that J / reference is about 1 in a good one.
class UntanglingMean {
 public:
  static constexpr double kEnough = 0.2;

  /// `moving`: the corner of the solid that is the star's vertex.
  template <class Solid>
  DMOSCOPE_ANYWHERE void add(const Solid& solid, Index moving, double reference) {
    const auto take = [this, reference](double jacobian) {
      sum_ += scalar::min(jacobian / reference, kEnough);
      ++count_;
      return jacobian;
    };
    if constexpr (requires { solid.six_volume; })
      (void)take(solid.six_volume);
    else
      (void)solid.least_around(moving, [&](Vec3, Vec3, Vec3, double jacobian) { return take(jacobian); });
  }
  [[nodiscard]] DMOSCOPE_ANYWHERE double value() const { return count_ > 0 ? sum_ / count_ : 0.0; }

 private:
  double sum_ = 0.0;
  int count_ = 0;
};

/// The worth of a star with its vertex at a place. Where no corner is inverted: the least metric. Else, where the least Jacobian of the
/// corners that change with the vertex is not below that of its own place (or is positive): the mean, put between -1 and 0. Else below -1.
template <Metric M, class StarT>
class SolidUntangling {
 public:
  explicit DMOSCOPE_ANYWHERE SolidUntangling(StarT star) : star_(star), floor_(scalar::min(look(Vec3{}).jacobian, 0.0)) {}

  [[nodiscard]] DMOSCOPE_ANYWHERE double operator()(Vec3 p) const {
    const Look at = look(p);
    if (at.jacobian > 0.0 && at.quality > 0.0) return at.quality;
    if (at.jacobian < floor_) return -1.0 + bounded(at.jacobian);
    return bounded(at.mean.value() - UntanglingMean::kEnough);
  }

 private:
  struct Look {
    double jacobian, quality;
    UntanglingMean mean;
  };
  /// From (-infinity, 0] to (-1, 0].
  static DMOSCOPE_ANYWHERE double bounded(double a) { return a / (1.0 - a); }

  [[nodiscard]] DMOSCOPE_ANYWHERE Look look(Vec3 p) const {
    constexpr double kMost = std::numeric_limits<double>::max();
    Look found{kMost, kMost, {}};
    star_.template for_each<formulas::kDefinedForCorners<M>>([&found, p](const auto& element) {
      const auto solid = element.with(p);
      found.quality = scalar::min(found.quality, formulas::metric_around<M>(solid, element.kMoving));
      found.jacobian = scalar::min(found.jacobian, formulas::smallest_jacobian_around(solid, element.kMoving) / element.reference);
      found.mean.add(solid, element.kMoving, element.reference);
    });
    return found;
  }

  StarT star_;
  double floor_;
};

/// What raises a star that has inverted elements, and is positive where it has none. Point: of the plane or of space.
template <Metric M, class StarT, class Point>
using UntanglingObjective =
    std::conditional_t<std::is_same_v<Point, Vec3>, SolidUntangling<M, StarT>, Objective<M, true, double, Value::Metric, StarT>>;

}  // namespace dmoscope
