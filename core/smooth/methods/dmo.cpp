#include "core/smooth/methods/dmo.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <optional>
#include <utility>

#include "core/base/memory.h"
#include "core/smooth/kernels/lane_kernel.h"
#include "core/smooth/methods/defined_dmo.h"
#include "core/smooth/methods/defined_rule.h"
#include "core/smooth/methods/fast_volume_search.h"
#include "core/smooth/methods/slide.h"
#include "core/smooth/vertex_rule.h"

namespace dmoscope {

namespace {

/// The plain search in double.
template <Metric M, class Frame>
class Reference {
 public:
  using Scratch = StarIn<Frame, double>;
  static constexpr std::size_t kGrain = std::is_same_v<Frame, Plane> ? 32 : 1;
  Reference(const InputMesh& input, const SearchParameters& parameters) : mesh_(input), parameters_(parameters) {}

  void begin(const Sweep& sweep) { mesh_.untangling = sweep.untangling; }
  std::optional<Vec3> target(PositionView positions, Index vertex, Scratch& star) const {
    gather_star(MeshStar(mesh_.view, positions, vertex), star);
    const OffsetIn<Frame, double> found = search_star<M>(StarViewIn<Frame, double>(star), star.box, parameters_, mesh_.untangling);
    if (found == OffsetIn<Frame, double>{}) return std::nullopt;
    return mesh_.template moved_if_gaining<M>(positions, vertex, found, star.scale);
  }

  bool gains(Index vertex, Vec3 target, PositionView positions) const {
    return gains_at<M>(mesh_.view, positions, vertex, target, mesh_.untangling);
  }

 private:
  RuleMesh<Frame> mesh_;
  SearchParameters parameters_;
};

/// For speed: lanes of many vertices. Works on its own copy of the positions in the order of the visits, and keeps who needs no visit
/// because nothing of its star moved since it was last found at its best.
template <Metric M>
class LaneDmo final : public Smoother {
 public:
  explicit LaneDmo(const SmoothingTask& task)
      : input_(task.input),
        colouring_(task.colouring),
        reference_(*input_, task.search),
        slide_(task, single_objective(M)),
        table_(build_star_table(input_->mesh, input_->topology, *colouring_, task.pool)),
        kernel_(lane_kernel(task.search.simd.value_or(best_simd_level()), M)),
        ranked_(large_vector<Vec3>(table_.vertex_of_rank.size())),
        awake_(large_vector<std::uint8_t>(table_.vertex_of_rank.size())),
        task_(describe(task.search)) {
    for (std::size_t rank = 0; rank < colouring_->order.size(); ++rank)
      if (slide_.slides(colouring_->order[rank])) table_.shapes[rank].kind = StarShape::Kind::Alone;
  }

  void begin(const Sweep& sweep) override {
    reference_.begin(sweep);
    slide_.begin(sweep);
    if (sweep.untangling != untangling_) std::ranges::fill(awake_, std::uint8_t{1});
    untangling_ = sweep.untangling;
  }
  std::uint64_t visit(std::uint64_t first, std::uint64_t count, std::span<Vec3> positions, ThreadPool* pool) override {
    if (stale_) load(positions, pool);
    std::atomic<std::uint64_t> moved{0}, searched{0};
    stored_ = false;
    for_classes(*colouring_, first, count, [&](std::uint64_t from, std::uint64_t to) {
      const auto chunk = [&](std::size_t begin, std::size_t end) {
        // Those of one class do not wake each other, so who is awake now is who will be visited.
        const auto here = std::span(awake_).subspan(from + begin, end - begin);
        searched += untangling_.repair ? here.size() : static_cast<std::uint64_t>(std::ranges::count(here, std::uint8_t{1}));
        moved += untangling_.repair ? repair(from + begin, from + end) : kernel_(task_, from + begin, from + end);
      };
      for_chunks(pool, to - from, kLaneGrain, std::cref(chunk));  // by reference: a function object of this size would be allocated
    });
    searched_ += searched;
    return moved;
  }
  [[nodiscard]] std::optional<std::uint64_t> searched() const noexcept override { return searched_; }
  void store(std::span<Vec3> positions, ThreadPool* pool) override {
    if (stored_ || stale_) return;
    for_chunks(pool, positions.size(), kCopyGrain, [&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v) positions[v] = ranked_[table_.rank_of_vertex[v]];
    });
    stored_ = true;
  }
  void positions_replaced() override { stale_ = true; }
  void give(std::span<const Index> vertices, std::span<const Vec3> /*positions*/, std::span<Vec3> places) const override {
    for (std::size_t i = 0; i < vertices.size(); ++i) places[i] = ranked_[table_.rank_of_vertex[vertices[i]]];
  }
  void take(std::span<const Index> vertices, std::span<const Vec3> places, std::span<Vec3> /*positions*/) override {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      Vec3& here = ranked_[table_.rank_of_vertex[vertices[i]]];
      if (here == places[i]) continue;
      here = places[i];
      for (const Incidence& at : input_->topology.star(vertices[i]))
        for (const Index other : input_->mesh.elements.corners(at.element)) awake_[table_.rank_of_vertex[other]] = 1;
    }
    stored_ = false;
  }

 private:
  static constexpr std::size_t kCopyGrain = std::size_t{1} << 16U;

  /// What does not change between visits.
  LaneTask describe(const SearchParameters& parameters) {
    LaneTask task{};
    task.shapes = table_.shapes.data();
    task.others = table_.others.data();
    task.ranked = ranked_.empty() ? nullptr : &ranked_[0].x;
    task.awake = awake_.data();
    task.frame = make_search_frame(*input_);
    task.parameters = parameters;
    task.owner = this;
    task.gains = [](void* owner, Index rank, const double* p) {
      auto& self = *static_cast<LaneDmo*>(owner);
      return self.reference_.gains(self.table_.vertex_of_rank[rank], {p[0], p[1], p[2]}, self.view());
    };
    task.visit_alone = [](void* owner, Index rank) {
      auto& self = *static_cast<LaneDmo*>(owner);
      thread_local Slide<Plane>::Scratch room;  // kept: stepping allocates nothing
      const Index vertex = self.table_.vertex_of_rank[rank];
      const auto target = self.slide_.slides(vertex) ? self.slide_.target(self.view(), vertex, room)
                                                     : self.reference_.target(self.view(), vertex, room.star);
      if (target) self.ranked_[rank] = *target;
      return target.has_value();
    };
    return task;
  }

  /// Lanes are for sound stars, which wait.
  std::uint64_t repair(std::uint64_t first, std::uint64_t last) {
    std::uint64_t moved = 0;
    for (std::uint64_t rank = first; rank < last; ++rank) moved += task_.visit_alone(this, static_cast<Index>(rank)) ? 1U : 0U;
    return moved;
  }

  void load(std::span<const Vec3> positions, ThreadPool* pool) {
    for_chunks(pool, ranked_.size(), kCopyGrain, [&](std::size_t first, std::size_t last) {
      for (std::size_t rank = first; rank < last; ++rank) {
        ranked_[rank] = positions[table_.vertex_of_rank[rank]];
        awake_[rank] = 1;
      }
    });
    stale_ = false;
  }

  [[nodiscard]] PositionView view() const { return {ranked_, table_.rank_of_vertex}; }

  std::shared_ptr<const InputMesh> input_;
  std::shared_ptr<const Colouring> colouring_;
  Reference<M, Plane> reference_;
  Slide<Plane> slide_;
  StarTable table_;
  LaneKernel kernel_;
  std::vector<Vec3> ranked_;
  std::vector<std::uint8_t> awake_;
  LaneTask task_;
  bool stale_ = true;    // ranked_ is older than the run's positions
  bool stored_ = false;  // and these are as new as ranked_
  std::uint64_t searched_ = 0;
  Untangling untangling_{};  // by which those asleep stay
};

}  // namespace

StarState star_state(const InputMesh& input, PositionView positions, Metric metric, Index vertex) {
  if (!is_built_in(metric)) {
    const auto judge = input.quality_context().judge(metric);
    const auto state = [&]<class Frame>() {
      return defined_star_state(defined_star_judge<Frame>(input, *judge), positions, vertex, positions[vertex]);
    };
    return input.is_surface() ? state.template operator()<Curved>() : with_frame(input, state);
  }
  if (input.is_surface()) return metric_functions<Curved>(metric).state(input.view<Curved>(), positions, vertex, positions[vertex]);
  return with_metric_and_frame(
      input, metric, [&]<Metric M, class Frame>() { return star_state<M>(input.view<Frame>(), positions, vertex, positions[vertex]); });
}

std::unique_ptr<Smoother> make_dmo_smoother(const SmoothingTask& task) {
  if (task.input->is_surface()) return make_surface_smoother(task, single_objective(task.metric));
  if (!is_built_in(task.metric)) return make_defined_dmo_smoother(task);
  return with_metric_and_frame(*task.input, task.metric, [&]<Metric M, class Frame>() -> std::unique_ptr<Smoother> {
    if (task.search.precision == Precision::Float) {
      if constexpr (std::is_same_v<Frame, Plane>)
        return std::make_unique<LaneDmo<M>>(task);
      else
        return make_sliding_smoother<Space>(task, FastVolumeSearch<M>(task), single_objective(M));
    }
    return make_sliding_smoother<Frame>(task, Reference<M, Frame>(*task.input, task.search), single_objective(M));
  });
}

}  // namespace dmoscope
