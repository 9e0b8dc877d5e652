#include "core/smooth/dmo.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>

#include "core/search/grid_search.h"
#include "core/search/packed_star.h"

namespace dmoscope {

namespace {

constexpr std::size_t kGrain = 256;  // vertices a chunk: some 0.5 ms of work

/// position + displacement, but a coordinate that does not move keeps its very bits (-0.0 + 0.0 would not). `single_precision`: see Mesh.
Vec3 displaced(Vec3 position, Vec3 displacement, bool single_precision) {
  const auto add = [single_precision](double a, double b) {
    if (b == 0.0) return a;
    return single_precision ? static_cast<double>(static_cast<float>(a + b)) : a + b;
  };
  return {add(position.x, displacement.x), add(position.y, displacement.y), add(position.z, displacement.z)};
}

/// Searches one lane. The untangling objective costs more and is needed only where an element of the star is inverted now; in a slot
/// without one it finds the same candidate, since there every candidate it values otherwise is <= 0 and cannot win.
template <Metric M, class Real>
Candidate<Real> search_lane(const Star<Real>& star, const SearchParameters& parameters) {
  const Objective<M, true, Real> untangling(star);
  const bool valid = scalar::all(untangling(Vec2<Real>{}) > Real(0));
  return valid ? grid_search<Real>(Objective<M, false, Real>(star), star.box, parameters)
               : grid_search<Real>(untangling, star.box, parameters);
}

/// What both executors share: who is visited, and the confirmation in double.
template <Metric M>
class DmoSmoother : public Smoother {
 public:
  DmoSmoother(std::shared_ptr<const InputMesh> input, const SearchParameters& parameters)
      : input_(std::move(input)), parameters_(parameters) {}

  std::uint64_t visit(std::span<const Index> vertices, std::span<Vec3> positions, ThreadPool* pool) final {
    std::atomic<std::uint64_t> moved{0};
    for_chunks(pool, vertices.size(), kGrain,
               [&](std::size_t first, std::size_t last) { moved += visit_chunk(vertices.subspan(first, last - first), positions); });
    return moved;
  }

 protected:
  virtual std::uint64_t visit_chunk(std::span<const Index> vertices, std::span<Vec3> positions) const = 0;

  template <class Real>
  void gather(Index vertex, std::span<const Vec3> positions, Star<Real>& star) const {
    gather_star(input_->quality_context(), input_->topology, positions, input_->reference_measure, vertex, star);
  }

  /// The search may be in float and in other rounding than the statistics; what counts is judged by the statistics' own functions.
  bool move_if_better(Index vertex, std::span<Vec3> positions, Vec2<double> offset) const {
    if (offset.x == 0.0 && offset.y == 0.0) return false;
    const Vec3 old = positions[vertex];
    const StarState before = star_state(*input_, positions, M, vertex);
    positions[vertex] = displaced(old, input_->geometry.plane.lift(offset), input_->mesh.single_precision);
    if (star_state(*input_, positions, M, vertex).better_than(before)) return true;
    positions[vertex] = old;
    return false;
  }

  [[nodiscard]] const SearchParameters& parameters() const { return parameters_; }

 private:
  std::shared_ptr<const InputMesh> input_;
  SearchParameters parameters_;
};

/// The reference: one vertex after the other, in double.
template <Metric M>
class ScalarDmo final : public DmoSmoother<M> {
 public:
  using DmoSmoother<M>::DmoSmoother;

 private:
  std::uint64_t visit_chunk(std::span<const Index> vertices, std::span<Vec3> positions) const override {
    Star<double> star;
    std::uint64_t moved = 0;
    for (const Index vertex : vertices) {
      this->gather(vertex, positions, star);
      const Vec2<double> offset = search_lane<M>(star, this->parameters()).offset;
      moved += this->move_if_better(vertex, positions, {offset.x * star.scale, offset.y * star.scale}) ? 1U : 0U;
    }
    return moved;
  }
};

/// For speed: a lane holds kWidth vertices of the class as a pack of floats.
template <Metric M>
class PackedDmo final : public DmoSmoother<M> {
 public:
  using DmoSmoother<M>::DmoSmoother;

 private:
  static constexpr int kWidth = static_cast<int>(std::experimental::native_simd<float>::size());  // wider packs measured slower than double

  std::uint64_t visit_chunk(std::span<const Index> vertices, std::span<Vec3> positions) const override {
    std::array<Star<float>, kWidth> stars;
    PackedStar<kWidth> packed;
    std::uint64_t moved = 0;
    for (std::size_t first = 0; first < vertices.size(); first += kWidth) {
      const auto group = vertices.subspan(first, std::min<std::size_t>(kWidth, vertices.size() - first));
      for (std::size_t i = 0; i < group.size(); ++i) this->gather(group[i], positions, stars[i]);
      const auto gathered = std::span<const Star<float>>(stars).first(group.size());
      const auto offsets = search(gathered, packed);
      for (std::size_t i = 0; i < group.size(); ++i) {
        const Vec2<double> offset{static_cast<double>(offsets[i].x) * stars[i].scale, static_cast<double>(offsets[i].y) * stars[i].scale};
        moved += this->move_if_better(group[i], positions, offset) ? 1U : 0U;
      }
    }
    return moved;
  }

  /// The best offset of each star, in units of its scale.
  std::array<Vec2<float>, kWidth> search(std::span<const Star<float>> stars, PackedStar<kWidth>& packed) const {
    std::array<Vec2<float>, kWidth> offsets{};
    if (PackedStar<kWidth>::alike(stars)) {
      const auto found = search_lane<M>(packed.pack(stars), this->parameters()).offset;
      for (std::size_t i = 0; i < stars.size(); ++i) offsets[i] = {found.x[i], found.y[i]};
    } else {
      for (std::size_t i = 0; i < stars.size(); ++i) offsets[i] = search_lane<M>(stars[i], this->parameters()).offset;
    }
    return offsets;
  }
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
    if (parameters.precision == Precision::Double) return std::make_unique<ScalarDmo<M>>(std::move(input), parameters);
    return std::make_unique<PackedDmo<M>>(std::move(input), parameters);
  });
}

}  // namespace dmoscope
