#include "core/quality/quality.h"

#include <algorithm>
#include <limits>

#include "core/base/thread_pool.h"
#include "core/mesh/geographic.h"
#include "core/quality/defined_judge.h"
#include "core/quality/defined_quality.h"
#include "core/quality/element_shape.h"
#include "core/quality/tally.h"
#include "core/quality/validity.h"

namespace dmoscope {

namespace {

constexpr std::size_t kElementsAtOnce = 8192;

template <Metric M>
double quality_of(const QualityContext& context, PositionView positions, Index element) {
  return visit_element(context, positions, element, [](const auto& shape) { return evaluate<M>(shape); });
}

}  // namespace

std::shared_ptr<const DefinedJudges> make_defined_judges() { return std::make_shared<const DefinedJudges>(); }

std::shared_ptr<const DefinedJudge> QualityContext::judge(Metric metric) const {
  if (judges == nullptr) refuse_defined_metric();
  return judges->of(metric, mesh, {geometry, normals});
}

std::shared_ptr<const DefinedJudge> QualityContext::find_judge(Metric metric) const {
  if (judges == nullptr) refuse_defined_metric();
  return judges->find(metric, mesh, {geometry, normals});
}

double element_quality(const QualityContext& context, PositionView positions, Metric metric, Index element) {
  if (!is_built_in(metric)) {
    const auto judge = context.find_judge(metric);
    return judge ? defined_quality(context, *judge, positions, element) : std::numeric_limits<double>::quiet_NaN();
  }
  return formulas::with_metric(metric, [&]<Metric M>() { return quality_of<M>(context, positions, element); });
}

double smallest_jacobian(const QualityContext& context, PositionView positions, Index element) {
  return visit_element(context, positions, element, [](const auto& shape) -> double { return least_jacobian(shape); });
}

std::optional<Vec3> inverted_inside(const QualityContext& context, PositionView positions, Index element) {
  return visit_element(context, positions, element, []<class Shape>(const Shape& shape) -> std::optional<Vec3> {
    if constexpr (kHasInside<Shape>) {
      if (!(formulas::smallest_jacobian(shape) > 0.0)) return std::nullopt;
      const Validity validity = validity_of(shape);
      if (!validity.proved) return place_in(shape, validity.at);
    }
    return std::nullopt;
  });
}

Vec3 centroid(const QualityContext& context, PositionView positions, Index element) {
  const Plane& plane = context.geometry.plane;
  const auto corners = context.mesh.elements.corners(element);
  const Vec3 first = positions[corners[0]];
  Vec3 sum;
  for (const Index corner : corners)
    sum = sum + (plane.period > 0.0 ? first + plane.difference(positions[corner], first) : positions[corner]);
  Vec3 middle = (1.0 / static_cast<double>(corners.size())) * sum;
  if (plane.period > 0.0 && middle.x < plane.west) middle.x += plane.period;
  if (plane.period > 0.0 && middle.x > plane.west + plane.period) middle.x -= plane.period;
  return middle;
}

void InvertedCount::add(const QualityContext& context, PositionView positions, Index element, std::uint64_t number) {
  if (smallest_jacobian(context, positions, element) > 0.0) return;
  const std::optional<Vec3> inside = inverted_inside(context, positions, element);
  ++all;
  inside_alone += inside ? 1 : 0;
  if (first.size() < kMostNamed)
    first.push_back({number, inside.has_value(), in_file(context.mesh, inside ? *inside : centroid(context, positions, element))});
}

InvertedCount count_inverted(const QualityContext& context, PositionView positions) {
  InvertedCount inverted;
  for (Index e = 0; e < context.mesh.elements.size(); ++e) inverted.add(context, positions, e, e);
  return inverted;
}

void element_qualities(const QualityContext& context, std::span<const Vec3> positions, Metric metric, ThreadPool* pool,
                       std::span<double> out) {
  for_chunks(pool, out.size(), kElementsAtOnce, [&](std::size_t first, std::size_t last) {
    for_blocks(context, positions, metric, first, last,
               [&](const ElementBlock& block) { std::ranges::copy(block.qualities(), out.begin() + block.first); });
  });
}

double vertex_quality(const QualityContext& context, const Topology& topology, std::span<const Vec3> positions, Metric metric,
                      Index vertex) {
  if (!is_built_in(metric)) {
    const auto judge = context.judge(metric);
    double least = std::numeric_limits<double>::infinity();
    for (const Incidence& incidence : topology.star(vertex))
      least = std::min(least, defined_quality(context, *judge, positions, incidence.element));
    return least;
  }
  return formulas::with_metric(metric, [&]<Metric M>() {
    double least = std::numeric_limits<double>::infinity();
    for (const Incidence& incidence : topology.star(vertex)) least = std::min(least, quality_of<M>(context, positions, incidence.element));
    return least;
  });
}

std::vector<Index> immovable_elements(const Mesh& mesh, std::span<const std::uint8_t> fixed, ThreadPool* pool) {
  const std::size_t count = mesh.elements.size();
  std::vector<std::vector<Index>> found((count + kElementsAtOnce - 1) / kElementsAtOnce);
  for_chunks(pool, count, kElementsAtOnce, [&](std::size_t first, std::size_t last) {
    for (std::size_t e = first; e < last; ++e) {
      const auto corners = mesh.elements.corners(static_cast<Index>(e));
      if (std::ranges::all_of(corners, [&](Index v) { return fixed[v] != 0; }))
        found[first / kElementsAtOnce].push_back(static_cast<Index>(e));
    }
  });
  std::vector<Index> all;
  for (const std::vector<Index>& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

Statistics compute_statistics(const QualityContext& context, std::span<const Vec3> positions, Metric metric,
                              std::span<const Index> immovable, ThreadPool* pool) {
  const std::size_t count = context.mesh.elements.size();
  constexpr std::size_t kStretch = Tally::kStretch;
  static_assert(kElementsAtOnce % kStretch == 0);
  std::vector<Tally> tallies((count + kStretch - 1) / kStretch);
  for_chunks(pool, count, kElementsAtOnce, [&](std::size_t first, std::size_t last) {
    for (std::size_t begin = first; begin < last; begin += kStretch) {
      Tally tally;  // here and not in the vector: threads would take its memory from each other with every block
      for_blocks(context, positions, metric, begin, std::min(begin + kStretch, last),
                 [&](const ElementBlock& block) { tally.add(block, immovable); });
      tallies[begin / kStretch] = tally;
    }
  });
  TallyTotal total;
  for (const Tally& tally : tallies) total.append(tally);  // in the order of the elements: the same sum for any number of threads
  return total.statistics();
}

Statistics compute_statistics(const QualityContext& context, std::span<const Vec3> positions, Metric metric,
                              std::span<const std::uint8_t> fixed, ThreadPool* pool) {
  return compute_statistics(context, positions, metric, immovable_elements(context.mesh, fixed, pool), pool);
}

}  // namespace dmoscope
