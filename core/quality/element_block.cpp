#include "core/quality/element_block.h"

#include <algorithm>
#include <limits>

#include "core/numeric/pack.h"
// After the packs:
#include "core/quality/defined_quality.h"
#include "core/quality/element_shape.h"
#include "core/quality/validity.h"

namespace dmoscope {

namespace {

using Real = Pack<double>;
constexpr std::size_t kWidth = Real::size;

struct Judged {
  double quality, jacobian;
};

template <Metric M>
void judge_one_by_one(const QualityContext& context, std::span<const Vec3> positions, ElementBlock& block, std::size_t first,
                      std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    const Judged judged = visit_element(context, positions, block.first + static_cast<Index>(i), [](const auto& element) {
      return Judged{evaluate<M>(element), least_jacobian(element)};
    });
    block.quality[i] = judged.quality;
    block.jacobian[i] = judged.jacobian;
  }
}

/// The coordinates that u and v of a plane are; null where the plane is parallel to no coordinate plane.
struct Axes {
  double Vec3::*u = nullptr;
  double Vec3::*v = nullptr;

  explicit Axes(const Plane& plane) {
    constexpr std::array kCoordinates{&Vec3::x, &Vec3::y, &Vec3::z};
    const PlaneAxes axes(plane);
    if (axes.u < 0) return;
    u = kCoordinates[static_cast<std::size_t>(axes.u)];
    v = kCoordinates[static_cast<std::size_t>(axes.v)];
  }
};

/// Corners of planar elements of one kind as differences from their first, coordinate by coordinate: those of the plane where they are
/// ones of space, else all three.
template <std::size_t kCorners, bool kAligned>
class Differences {
 public:
  Differences(const Plane& plane, const Axes& axes) : plane_(plane), axes_(axes) {}

  void gather(const Index* corners, std::span<const Vec3> positions, std::size_t count) {
    if (plane_.period > 0.0) return gather_shortest(corners, positions, count);
    for (std::size_t i = 0; i < count; ++i, corners += kCorners) {
      const Vec3& origin = positions[corners[0]];
      for (std::size_t k = 0; k < kOthers; ++k) {
        const Vec3& corner = positions[corners[k + 1]];
        if constexpr (kAligned) {
          at_[0][k][i] = corner.*axes_.u - origin.*axes_.u;
          at_[1][k][i] = corner.*axes_.v - origin.*axes_.v;
        } else {
          at_[0][k][i] = corner.x - origin.x;
          at_[1][k][i] = corner.y - origin.y;
          at_[2][k][i] = corner.z - origin.z;
        }
      }
    }
  }

  /// The elements i, i + 1, ... of a pack.
  [[nodiscard]] auto shape(std::size_t i) const {
    const Vec2<Real> origin{Real(0.0), Real(0.0)};
    if constexpr (kCorners == 3)
      return formulas::Triangle<Vec2<Real>>(origin, project(0, i), project(1, i));
    else
      return formulas::Quadrilateral<Vec2<Real>>(origin, project(0, i), project(1, i), project(2, i));
  }

 private:
  static constexpr std::size_t kOthers = kCorners - 1;

  /// For a mesh that wraps, where u is x and v is y.
  void gather_shortest(const Index* corners, std::span<const Vec3> positions, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i, corners += kCorners)
      for (std::size_t k = 0; k < kOthers; ++k) {
        const Vec3 way = plane_.difference(positions[corners[k + 1]], positions[corners[0]]);
        at_[0][k][i] = way.x;
        at_[1][k][i] = way.y;
        if constexpr (!kAligned) at_[2][k][i] = way.z;
      }
  }

  /// See Plane::project: times 1 and plus 0 change at most a zero's sign.
  [[nodiscard]] Vec2<Real> project(std::size_t k, std::size_t i) const {
    const auto load = [&](std::size_t coordinate) { return Real::load_aligned(&at_[coordinate][k][i]); };
    if constexpr (kAligned) {
      return {load(0), load(1)};
    } else {
      const auto along = [x = load(0), y = load(1), z = load(2)](Vec3 axis) {
        return x * Real(axis.x) + y * Real(axis.y) + z * Real(axis.z);
      };
      return {along(plane_.u), along(plane_.v)};
    }
  }

  const Plane& plane_;
  const Axes& axes_;
  alignas(64) double at_[kAligned ? 2 : 3][kOthers][ElementBlock::kSize];
};

/// The elements [first, last) of the block.
template <Metric M, std::size_t kCorners, bool kAligned>
void judge_in_packs(const QualityContext& context, std::span<const Vec3> positions, const Axes& axes, ElementBlock& block,
                    std::size_t first, std::size_t last) {
  const std::size_t whole = (last - first) / kWidth * kWidth;
  Differences<kCorners, kAligned> differences(context.geometry.plane, axes);
  differences.gather(context.mesh.elements.corners(block.first + static_cast<Index>(first)).data(), positions, whole);
  for (std::size_t i = 0; i < whole; i += kWidth) {
    const auto shape = differences.shape(i);
    evaluate<M>(shape).store_unaligned(&block.quality[first + i]);
    formulas::smallest_jacobian(shape).store_unaligned(&block.jacobian[first + i]);
  }
  judge_one_by_one<M>(context, positions, block, first + whole, last);
}

template <Metric M, std::size_t kCorners>
void judge_in_packs(const QualityContext& context, std::span<const Vec3> positions, ElementBlock& block, std::size_t first,
                    std::size_t last) {
  const Axes axes(context.geometry.plane);
  if (axes.u != nullptr)
    judge_in_packs<M, kCorners, true>(context, positions, axes, block, first, last);
  else
    judge_in_packs<M, kCorners, false>(context, positions, axes, block, first, last);
}

/// Volume elements of one kind, [first, last) of the block. Only what a pack does not prove valid inside is looked at alone.
template <Metric M>
void judge_volumes_in_packs(const QualityContext& context, std::span<const Vec3> positions, ElementBlock& block, std::size_t first,
                            std::size_t last) {
  constexpr std::array<Index, 8> kOwn{0, 1, 2, 3, 4, 5, 6, 7};
  const auto corners = [&](std::size_t i) { return context.mesh.elements.corners(block.first + static_cast<Index>(i)); };
  const auto own = std::span(kOwn).first(corners(first).size());
  for (; first + kWidth <= last; first += kWidth) {
    alignas(64) double at[3][kOwn.size()][kWidth], least[kWidth];
    for (std::size_t slot = 0; slot < kWidth; ++slot)
      for (std::size_t k = 0; k < own.size(); ++k) {
        const Vec3& p = positions[corners(first + slot)[k]];
        at[0][k][slot] = p.x, at[1][k][slot] = p.y, at[2][k][slot] = p.z;
      }
    const auto load = [&](Index k) {
      return Vec3Of<Real>{Real::load_aligned(at[0][k]), Real::load_aligned(at[1][k]), Real::load_aligned(at[2][k])};
    };
    visit_volume(own, load, [&](const auto& shape) {
      evaluate<M>(shape).store_unaligned(&block.quality[first]);
      formulas::smallest_jacobian(shape).store_unaligned(&block.jacobian[first]);
      if constexpr (requires { validity::coefficients_of(shape); }) validity::least_coefficient(shape).store_aligned(least);
    });
    if (own.size() != 6 && own.size() != 8) continue;  // corners tell all
    for (std::size_t slot = 0; slot < kWidth; ++slot)
      if (!(least[slot] > validity::kRounding) && block.jacobian[first + slot] > 0.0)
        block.jacobian[first + slot] = smallest_jacobian(context, positions, block.first + static_cast<Index>(first + slot));
  }
  judge_one_by_one<M>(context, positions, block, first, last);
}

template <Metric M>
void judge(const QualityContext& context, std::span<const Vec3> positions, ElementBlock& block) {
  const auto kinds = context.mesh.elements.kinds().subspan(block.first, block.count);
  std::size_t first = 0;
  while (first < block.count) {  // stretches of one kind
    std::size_t last = first + 1;
    while (last < block.count && kinds[last] == kinds[first]) ++last;
    const bool planar = context.geometry.shape == Shape::Planar;
    if (planar && kinds[first] == ElementKind::Triangle)
      judge_in_packs<M, 3>(context, positions, block, first, last);
    else if (planar && kinds[first] == ElementKind::Quadrilateral)
      judge_in_packs<M, 4>(context, positions, block, first, last);
    else if (info(kinds[first]).dimension == 3)
      judge_volumes_in_packs<M>(context, positions, block, first, last);
    else
      judge_one_by_one<M>(context, positions, block, first, last);
    first = last;
  }
}

}  // namespace

BlockJudge::BlockJudge(const QualityContext& context, Metric metric) {
  if (is_built_in(metric))
    built_in_ = formulas::with_metric(metric, []<Metric M>() -> BuiltIn { return &judge<M>; });
  else
    defined_ = context.find_judge(metric);
}

void BlockJudge::operator()(const QualityContext& context, std::span<const Vec3> positions, ElementBlock& block) const {
  if (built_in_ != nullptr) return built_in_(context, positions, block);
  if (defined_)
    defined_qualities(context, *defined_, positions, block.first, block.count, block.quality.data());
  else
    std::fill_n(block.quality.begin(), block.count, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < block.count; ++i)
    block.jacobian[i] = smallest_jacobian(context, PositionView(positions), block.first + static_cast<Index>(i));
}

}  // namespace dmoscope
