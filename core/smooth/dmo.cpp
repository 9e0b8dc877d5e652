#include "core/smooth/dmo.h"

#include <algorithm>
#include <atomic>
#include <limits>

#include "core/search/grid_search.h"

namespace dmoscope {

namespace {

constexpr std::size_t kGrain = 256;  // vertices a chunk: some 0.5 ms of work

/// position + displacement, but a coordinate that does not move keeps its very bits (-0.0 + 0.0 would not).
Vec3 displaced(Vec3 position, Vec3 displacement) {
  const auto add = [](double a, double b) { return b == 0.0 ? a : a + b; };
  return {add(position.x, displacement.x), add(position.y, displacement.y), add(position.z, displacement.z)};
}

template <Metric M, class Real>
class DmoSmoother final : public Smoother {
 public:
  DmoSmoother(std::shared_ptr<const InputMesh> input, const SearchParameters& parameters)
      : input_(std::move(input)), parameters_(parameters) {}

  std::uint64_t visit(std::span<const Index> vertices, std::span<Vec3> positions, ThreadPool* pool) override {
    std::atomic<std::uint64_t> moved{0};
    for_chunks(pool, vertices.size(), kGrain, [&](std::size_t first, std::size_t last) {
      Star<Real> star;
      std::uint64_t moved_here = 0;
      for (std::size_t i = first; i < last; ++i) moved_here += visit_vertex(vertices[i], positions, star) ? 1U : 0U;
      moved += moved_here;
    });
    return moved;
  }

 private:
  bool visit_vertex(Index vertex, std::span<Vec3> positions, Star<Real>& star) const {
    gather_star(input_->quality_context(), input_->topology, positions, input_->reference_measure, vertex, star);
    const Candidate<Real> best = search(star);
    if (best.offset.x == Real(0) && best.offset.y == Real(0)) return false;
    return move_if_better(vertex, positions,
                          {static_cast<double>(best.offset.x) * star.scale, static_cast<double>(best.offset.y) * star.scale});
  }

  /// The untangling objective costs more and is needed only where an element of the star is inverted now.
  Candidate<Real> search(const Star<Real>& star) const {
    const Objective<M, true, Real> untangling(star);
    if (untangling(Vec2<Real>{}) > Real(0)) return grid_search<Real>(Objective<M, false, Real>(star), star.box, parameters_);
    return grid_search<Real>(untangling, star.box, parameters_);
  }

  /// The search may be in float and in other rounding than the statistics; what counts is judged by the statistics' own functions.
  bool move_if_better(Index vertex, std::span<Vec3> positions, Vec2<double> offset) const {
    const Vec3 old = positions[vertex];
    const StarState before = star_state(*input_, positions, M, vertex);
    positions[vertex] = displaced(old, input_->geometry.plane.lift(offset));
    if (star_state(*input_, positions, M, vertex).better_than(before)) return true;
    positions[vertex] = old;
    return false;
  }

  std::shared_ptr<const InputMesh> input_;
  SearchParameters parameters_;
};

}  // namespace

StarState star_state(const InputMesh& input, std::span<const Vec3> positions, Metric metric, Index vertex) {
  const QualityContext context = input.quality_context();
  StarState state{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (const Incidence& at : input.topology.star(vertex)) {
    state.jacobian = std::min(state.jacobian, smallest_jacobian(context, positions, at.element) / input.reference_measure[at.element]);
    state.quality = std::min(state.quality, element_quality(context, positions, metric, at.element));
  }
  return state;
}

std::unique_ptr<Smoother> make_dmo_smoother(std::shared_ptr<const InputMesh> input, Metric metric, const SearchParameters& parameters) {
  return formulas::with_metric(metric, [&]<Metric M>() -> std::unique_ptr<Smoother> {
    if (parameters.precision == Precision::Double) return std::make_unique<DmoSmoother<M, double>>(std::move(input), parameters);
    return std::make_unique<DmoSmoother<M, float>>(std::move(input), parameters);
  });
}

}  // namespace dmoscope
