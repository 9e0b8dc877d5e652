#include "core/smooth/dmo.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "core/base/memory.h"
#include "core/search/grid_search.h"
#include "core/smooth/displace.h"
#include "core/smooth/lane_kernel.h"

namespace dmoscope {

namespace {

constexpr std::size_t kGrain = 256;  // vertices a chunk of the reference: some 1 ms of work

/// The untangling objective costs more and is needed only where an element of the star is inverted now; of one without, it finds the
/// same candidate, since there every candidate it values otherwise is <= 0 and cannot win.
template <Metric M>
Candidate<double> search_star(const Star<double>& star, const SearchParameters& parameters) {
  const Objective<M, true, double> untangling(star);
  const bool valid = untangling({}) > 0.0;
  return valid ? grid_search<double>(Objective<M, false, double>(star), star.box, parameters)
               : grid_search<double>(untangling, star.box, parameters);
}

/// One vertex after the other, in double: the plain search, which the fast one is compared with and falls back to.
template <Metric M>
class Reference {
 public:
  Reference(const InputMesh& input, const SearchParameters& parameters) : input_(input), parameters_(parameters) {}

  /// Moves `vertex` if it gains. `star`: room to work in.
  bool visit(Index vertex, std::span<Vec3> positions, Star<double>& star) const {
    gather_star(input_.quality_context(), input_.topology, positions, input_.reference_measure, vertex, star);
    const Vec2<double> found = search_star<M>(star, parameters_).offset;
    const Vec2<double> offset{found.x * star.scale, found.y * star.scale};
    if (offset.x == 0.0 && offset.y == 0.0) return false;
    const Vec3 old = positions[vertex], step = input_.geometry.plane.lift(offset);
    const bool single = input_.mesh.single_precision;
    const Vec3 target{displaced(old.x, step.x, single), displaced(old.y, step.y, single), displaced(old.z, step.z, single)};
    if (!gains(vertex, target, positions)) return false;
    positions[vertex] = target;
    return true;
  }

  /// A search may be in float and in other rounding than the statistics; what counts is judged by the statistics' own functions.
  bool gains(Index vertex, Vec3 target, std::span<Vec3> positions) const {
    const StarState before = star_state(input_, positions, M, vertex);
    const Vec3 old = std::exchange(positions[vertex], target);
    const bool better = star_state(input_, positions, M, vertex).better_than(before);
    positions[vertex] = old;
    return better;
  }

 private:
  const InputMesh& input_;
  SearchParameters parameters_;
};

template <Metric M>
class ScalarDmo final : public Smoother {
 public:
  ScalarDmo(std::shared_ptr<const InputMesh> input, std::shared_ptr<const Colouring> colouring, const SearchParameters& parameters)
      : input_(std::move(input)), colouring_(std::move(colouring)), reference_(*input_, parameters) {}

  std::uint64_t visit(std::uint64_t first, std::uint64_t count, std::span<Vec3> positions, ThreadPool* pool) override {
    const auto vertices = std::span(colouring_->order).subspan(first, count);
    std::atomic<std::uint64_t> moved{0};
    for_chunks(pool, count, kGrain, [&](std::size_t begin, std::size_t end) {
      Star<double> star;
      std::uint64_t here = 0;
      for (std::size_t i = begin; i < end; ++i) here += reference_.visit(vertices[i], positions, star) ? 1U : 0U;
      moved += here;
    });
    return moved;
  }
  void positions_replaced() override {}

 private:
  std::shared_ptr<const InputMesh> input_;
  std::shared_ptr<const Colouring> colouring_;
  Reference<M> reference_;
};

/// For speed: lanes of many vertices. Keeps its own copy of the positions in the order of the visits, and who needs no visit because
/// nothing of its star moved since it was last found at its best.
template <Metric M>
class LaneDmo final : public Smoother {
 public:
  LaneDmo(std::shared_ptr<const InputMesh> input, std::shared_ptr<const Colouring> colouring, const SearchParameters& parameters,
          ThreadPool* pool)
      : input_(std::move(input)),
        reference_(*input_, parameters),
        table_(build_star_table(input_->mesh, input_->topology, *colouring, pool)),
        kernel_(lane_kernel(parameters.simd.value_or(best_simd_level()), M)),
        ranked_(large_vector<double>(3 * table_.vertex_of_rank.size())),
        awake_(large_vector<std::uint8_t>(table_.vertex_of_rank.size())),
        task_(describe(parameters)) {}

  std::uint64_t visit(std::uint64_t first, std::uint64_t count, std::span<Vec3> positions, ThreadPool* pool) override {
    if (positions_.data() != positions.data()) positions_replaced();
    positions_ = positions;
    if (stale_) load(pool);
    task_.positions = &positions[0].x;
    std::atomic<std::uint64_t> moved{0};
    const auto chunk = [&](std::size_t begin, std::size_t end) { moved += kernel_(task_, first + begin, first + end); };
    for_chunks(pool, count, kLaneGrain, std::cref(chunk));  // by reference: a function object of this size would be allocated
    return moved;
  }
  void positions_replaced() override { stale_ = true; }

 private:
  /// What does not change between visits.
  LaneTask describe(const SearchParameters& parameters) {
    const Plane& plane = input_->geometry.plane;
    LaneTask task{};
    task.shapes = table_.shapes.data();
    task.others = table_.others.data();
    task.vertex_of_rank = table_.vertex_of_rank.data();
    task.ranked = ranked_.data();
    task.awake = awake_.data();
    const auto take = [](Vec3 from, double* to) { to[0] = from.x, to[1] = from.y, to[2] = from.z; };
    take(plane.u, task.u);
    take(plane.v, task.v);
    const auto axis = [](const double* d) { return static_cast<int>(std::find(d, d + 3, 1.0) - d); };
    task.u_axis = axis(task.u);
    task.v_axis = axis(task.v);
    if (task.u_axis > 2 || task.v_axis > 2) task.u_axis = task.v_axis = -1;
    const double edge = input_->geometry.size / std::sqrt(1.0 + input_->mesh.elements.size());
    task.scale = edge > 0.0 && std::isfinite(edge) ? std::exp2(std::ilogb(edge)) : 1.0;
    task.inverse = 1.0 / task.scale;
    task.single_precision = input_->mesh.single_precision;
    task.parameters = parameters;
    task.owner = this;
    task.gains = [](const void* owner, Index vertex, const double* p) {
      const auto& self = *static_cast<const LaneDmo*>(owner);
      return self.reference_.gains(vertex, {p[0], p[1], p[2]}, self.positions_);
    };
    task.visit_alone = [](const void* owner, Index vertex) {
      const auto& self = *static_cast<const LaneDmo*>(owner);
      Star<double> star;
      return self.reference_.visit(vertex, self.positions_, star);
    };
    return task;
  }

  void load(ThreadPool* pool) {
    for_chunks(pool, table_.vertex_of_rank.size(), std::size_t{1} << 16U, [&](std::size_t first, std::size_t last) {
      for (std::size_t rank = first; rank < last; ++rank) {
        const Vec3 p = positions_[table_.vertex_of_rank[rank]];
        double* to = &ranked_[3 * rank];
        to[0] = p.x, to[1] = p.y, to[2] = p.z;
        awake_[rank] = 1;
      }
    });
    stale_ = false;
  }

  std::shared_ptr<const InputMesh> input_;
  Reference<M> reference_;
  StarTable table_;
  LaneKernel kernel_;
  std::vector<double> ranked_;
  std::vector<std::uint8_t> awake_;
  LaneTask task_;
  std::span<Vec3> positions_;
  bool stale_ = true;
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

std::unique_ptr<Smoother> make_dmo_smoother(std::shared_ptr<const InputMesh> input, std::shared_ptr<const Colouring> colouring,
                                            Metric metric, const SearchParameters& parameters, ThreadPool* pool) {
  return formulas::with_metric(metric, [&]<Metric M>() -> std::unique_ptr<Smoother> {
    if (parameters.precision == Precision::Double)
      return std::make_unique<ScalarDmo<M>>(std::move(input), std::move(colouring), parameters);
    return std::make_unique<LaneDmo<M>>(std::move(input), std::move(colouring), parameters, pool);
  });
}

}  // namespace dmoscope
