#pragma once
// Parts of a visit with two aims (see visit/star_judge.h) that run on any processor: the second aims, and the judgement of a place by both.

#include <cmath>
#include <cstdint>

#include "core/mesh/mesh_view.h"
#include "core/mesh/position_view.h"
#include "core/numeric/scalar.h"
#include "core/quality/power_mean.h"
#include "core/search/star.h"
#include "core/smooth/composite_objective.h"
#include "core/smooth/edge_neighbours.h"
#include "core/smooth/reference_visit.h"

namespace dmoscope {

/// Size function given by a formula, as plain data: any kind of SizeFunction but Field.
struct SizeFormula {
  SizeFunction::Kind kind = SizeFunction::Kind::Constant;
  Vec3 point{};
  double least_distance = 0.0;  // a vertex at the very point has a size, too
  [[nodiscard]] DMOSCOPE_ANYWHERE double at(const Plane& plane, Vec3 place) const {
    if (kind == SizeFunction::Kind::Constant) return 1.0;
    const Vec2<double> away = plane.offset(place, point);
    const double distance = scalar::max(std::sqrt(dot(away, away)), least_distance);
    return kind == SizeFunction::Kind::Distance ? distance : 1.0 / distance;
  }
  friend bool operator==(const SizeFormula&, const SizeFormula&) = default;
};

/// Returns whether a star whose least first metric is `least` is beyond the threshold: above it or, `inclusive`, not below it; with
/// inverted elements never.
[[nodiscard]] DMOSCOPE_ANYWHERE bool is_beyond(double least, double threshold, bool inclusive) {
  return inclusive ? least > 0.0 && least >= threshold : least > threshold;
}

/// Two aims without the first metric, as plain data. Not for sizes from a nodal field.
struct PlainComposite {
  enum class Second : std::uint8_t { Mean, Metric, Density };
  Second second = Second::Mean;
  MeanKind mean = MeanKind::Harmonic;                     // Second::Mean
  dmoscope::Metric metric = dmoscope::Metric::MeanRatio;  // Second::Metric
  double threshold = 0.0;
  SizeFormula size{};  // Second::Density
  [[nodiscard]] DMOSCOPE_ANYWHERE bool raise_mean() const { return second == Second::Mean; }
  [[nodiscard]] DMOSCOPE_ANYWHERE bool beyond(double least) const { return is_beyond(least, threshold, raise_mean()); }
  friend bool operator==(const PlainComposite&, const PlainComposite&) = default;
};

/// Best place of a vertex for density (paper eq. 7), and the density of other places (eq. 6, but bounded and free of scale).
template <class Frame>
struct DensityTarget {
  using Offset = OffsetIn<Frame, double>;
  Offset offset{};    // offset from the vertex's position
  double edge = 0.0;  // mean edge of the star
  /// Density of a place, 1 / (1 + d^2 / h^2); `at`: relative to the vertex's position.
  [[nodiscard]] DMOSCOPE_ANYWHERE double density(Offset at) const {
    const Offset away = at - offset;
    return edge > 0.0 ? 1.0 / (1.0 + dot(away, away) / (edge * edge)) : 0.0;
  }
  /// Target in units of `scale`.
  [[nodiscard]] DMOSCOPE_ANYWHERE DensityTarget in_units(double scale) const { return {times(offset, 1.0 / scale), edge / scale}; }
};

/// Mean of the edge neighbours, weighted by the inverse of the size at their present positions. size_at(vertex, place): h > 0.
template <class SizeAt>
[[nodiscard]] DMOSCOPE_ANYWHERE DensityTarget<Plane> density_target_by(const PlanarView& mesh, PositionView positions, Index vertex,
                                                                       const SizeAt& size_at) {
  const Vec3 here = positions[vertex];
  Vec2<double> sum{};
  double weights = 0.0, lengths = 0.0, count = 0.0;
  for_edge_neighbours(mesh, vertex, [&](Index other) {
    const Vec2<double> edge = mesh.frame.offset(positions[other], here);
    const double weight = 1.0 / size_at(other, positions[other]);
    sum = {sum.x + weight * edge.x, sum.y + weight * edge.y};
    weights += weight;
    lengths += std::sqrt(dot(edge, edge));
    count += 1.0;
  });
  if (!(count > 0.0)) return {};
  return {{sum.x / weights, sum.y / weights}, lengths / count};
}

/// A mean of the metric of a star with its vertex at an offset, by the search's formulas; summed in the star's order.
template <Metric M, class StarT, class Point>
[[nodiscard]] DMOSCOPE_INLINE DMOSCOPE_ANYWHERE double mean_of(const StarT& star, Point p, MeanKind kind) {
  PowerMean<double> mean(kind);
  double count = 0.0;
  star.template for_each<true>([&](const auto& element) {
    mean.add(evaluate<M>(element.with(p)));
    count += 1.0;
  });
  return mean.value(count);
}

/// Mean of the metric of a star with the vertex at a place, by the statistics' formulas; summed in the star's order.
template <Metric M, class Frame>
[[nodiscard]] DMOSCOPE_INLINE DMOSCOPE_ANYWHERE double mean_at_place(const MeshView<Frame>& mesh, PositionView positions, Index vertex,
                                                                     Vec3 place, MeanKind kind) {
  const auto at = [&](Index v) { return v == vertex ? place : positions[v]; };
  PowerMean<double> mean(kind);
  for (const Incidence& incidence : mesh.star(vertex))
    visit_shape(mesh.frame_of(incidence.element), mesh.corners_of(incidence.element), at,
                [&mean](const auto& shape) { mean.add(evaluate<M>(shape)); });
  return mean.value(static_cast<double>(mesh.star(vertex).size()));
}

/// Outcome for a vertex that goes from a place with the star `before` to one with the star `after`. `aims`: PlainComposite or another type
/// with its beyond() and raise_mean(); confirm_soundness(tangled): see there; second_rises(): whether the second aim is greater there.
template <class CompositeT, class ConfirmSoundness, class SecondRises>
[[nodiscard]] DMOSCOPE_INLINE DMOSCOPE_ANYWHERE Confirmation confirm_composite(const CompositeT& aims, const StarState& before,
                                                                               const StarState& after, const Untangling& untangling,
                                                                               const ConfirmSoundness& confirm_soundness,
                                                                               const SecondRises& second_rises) {
  const bool tangled = !(before.jacobian > 0.0);
  bool decided = false;  // whether the answer needs no second aim
  if (tangled) {
    if (!after.better_than(before, untangling)) return Confirmation::GainsNothing;
    // Raising the mean lowers neither the minimum nor the mean, not even for the sake of untangling.
    decided = !aims.raise_mean();
    if (!decided && !(after.quality >= before.quality)) return Confirmation::GainsNothing;
  } else {
    if (untangling.repair || !(after.jacobian > 0.0)) return Confirmation::GainsNothing;
    decided = !aims.beyond(before.quality);
    if (!(decided ? after.quality > before.quality : aims.beyond(after.quality))) return Confirmation::GainsNothing;
  }
  const Confirmation confirmed = confirm_soundness(tangled);
  if (confirmed != Confirmation::Gains || decided) return confirmed;
  return second_rises() ? Confirmation::Gains : Confirmation::GainsNothing;  // one call alone: a device's code has a copy for each
}

}  // namespace dmoscope
