#include "core/quality/element_block.h"

#include <limits>

#include "core/search/pack.h"
// After the packs:
#include "core/quality/element_shape.h"

namespace dmoscope {

namespace {

using Real = Pack<double>;
constexpr std::size_t kWidth = Real::size;

/// What is the same for double and for packs of it. The library's functions of angles are not.
template <Metric M>
constexpr bool kSameInPacks = M != Metric::MinAngle&& M != Metric::MaxAngle&& M != Metric::Rectangularity;

struct Judged {
  double quality, jacobian;
};

template <Metric M>
void judge_one_by_one(const QualityContext& context, std::span<const Vec3> positions, ElementBlock& block, std::size_t first,
                      std::size_t last) {
  constexpr Judged kVolume{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()};
  for (std::size_t i = first; i < last; ++i) {
    const Judged judged = visit_element(context, positions, block.first + static_cast<Index>(i), kVolume, [](const auto& element) {
      return Judged{evaluate<M>(element), formulas::smallest_jacobian(element)};
    });
    block.quality[i] = judged.quality;
    block.jacobian[i] = judged.jacobian;
  }
}

/// Corners of planar elements of one kind as differences from their first, coordinate by coordinate.
template <std::size_t kCorners>
struct Differences {
  static constexpr std::size_t kOthers = kCorners - 1;
  alignas(64) double x[kOthers][ElementBlock::kSize], y[kOthers][ElementBlock::kSize], z[kOthers][ElementBlock::kSize];

  void gather(const Index* corners, std::span<const Vec3> positions, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i, corners += kCorners) {
      const Vec3 origin = positions[corners[0]];
      for (std::size_t k = 0; k < kOthers; ++k) {
        const Vec3 d = positions[corners[k + 1]] - origin;
        x[k][i] = d.x;
        y[k][i] = d.y;
        z[k][i] = d.z;
      }
    }
  }

  /// See Plane::project.
  [[nodiscard]] Vec2<Real> project(const Plane& plane, std::size_t k, std::size_t i) const {
    const Real a = Real::load_aligned(&x[k][i]), b = Real::load_aligned(&y[k][i]), c = Real::load_aligned(&z[k][i]);
    return {a * Real(plane.u.x) + b * Real(plane.u.y) + c * Real(plane.u.z),
            a * Real(plane.v.x) + b * Real(plane.v.y) + c * Real(plane.v.z)};
  }

  [[nodiscard]] auto shape(const Plane& plane, std::size_t i) const {
    using V = Vec2<Real>;
    const V origin{Real(0.0), Real(0.0)};
    if constexpr (kCorners == 3)
      return formulas::Triangle<V>(origin, project(plane, 0, i), project(plane, 1, i));
    else
      return formulas::Quadrilateral<V>(origin, project(plane, 0, i), project(plane, 1, i), project(plane, 2, i));
  }
};

/// The elements [first, last) of the block.
template <Metric M, std::size_t kCorners>
void judge_in_packs(const QualityContext& context, std::span<const Vec3> positions, ElementBlock& block, std::size_t first,
                    std::size_t last) {
  const std::size_t whole = (last - first) / kWidth * kWidth;
  Differences<kCorners> differences;
  differences.gather(context.mesh.elements.corners(block.first + static_cast<Index>(first)).data(), positions, whole);
  for (std::size_t i = 0; i < whole; i += kWidth) {
    const auto shape = differences.shape(context.geometry.plane, i);
    evaluate<M>(shape).store_unaligned(&block.quality[first + i]);
    formulas::smallest_jacobian(shape).store_unaligned(&block.jacobian[first + i]);
  }
  judge_one_by_one<M>(context, positions, block, first + whole, last);
}

template <Metric M>
void judge(const QualityContext& context, std::span<const Vec3> positions, ElementBlock& block) {
  const auto kinds = context.mesh.elements.kinds().subspan(block.first, block.count);
  std::size_t first = 0;
  while (first < block.count) {  // stretches of one kind
    std::size_t last = first + 1;
    while (last < block.count && kinds[last] == kinds[first]) ++last;
    const bool planar = context.geometry.shape == Shape::Planar;
    if (kSameInPacks<M> && planar && kinds[first] == ElementKind::Triangle)
      judge_in_packs<M, 3>(context, positions, block, first, last);
    else if (kSameInPacks<M> && planar && kinds[first] == ElementKind::Quadrilateral)
      judge_in_packs<M, 4>(context, positions, block, first, last);
    else
      judge_one_by_one<M>(context, positions, block, first, last);
    first = last;
  }
}

}  // namespace

BlockJudge block_judge(Metric metric) {
  return formulas::with_metric(metric, []<Metric M>() -> BlockJudge { return &judge<M>; });
}

}  // namespace dmoscope
