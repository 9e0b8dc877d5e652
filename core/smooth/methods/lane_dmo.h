#pragma once
// DMO of planar meshes by lanes of many vertices, for speed.

#include <algorithm>
#include <atomic>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/memory.h"
#include "core/smooth/kernels/compiled/kernel_set.h"
#include "core/smooth/kernels/lane_kernel.h"
#include "core/smooth/kernels/targets/star_targets.h"
#include "core/smooth/methods/grid.h"
#include "core/smooth/visit/visit.h"

namespace dmoscope {

/// Fast DMO on its own copy of the positions in the order of the visits. It notes the vertices that need no visit because nothing of their
/// star has moved since they were last found at their best.
class LaneDmo final : public Smoother {
 public:
  /// Function that makes the targets of the stars where the kernel is for them.
  using MakeTargets = std::function<StarTargets(const StarTable& table)>;
  /// `alone`: rule for single vertices.
  LaneDmo(const SmoothingTask& task, Visit<Plane, Grid> alone, LaneKernel kernel, const MakeTargets& targets = {})
      : input_(task.input),
        colouring_(task.colouring),
        pairs_(task.domain),
        alone_(std::move(alone)),
        table_(build_star_table(input_->mesh, input_->topology, *colouring_, task.pool)),
        targets_(targets ? targets(table_) : StarTargets{}),
        kernel_(kernel),
        ranked_(large_vector<Vec3>(table_.vertex_of_rank.size())),
        awake_(large_vector<std::uint8_t>(table_.vertex_of_rank.size())),
        task_(describe(task.search)) {
    if (pairs_ && pairs_->pairs().empty()) pairs_.reset();
    for (std::size_t rank = 0; rank < colouring_->order.size(); ++rank)
      if (alone_.slides(colouring_->order[rank])) table_.shapes[rank].kind = StarShape::Kind::Alone;
  }

  void begin(const Sweep& sweep) override {
    alone_.begin(sweep);
    if (sweep.untangling != untangling_) std::ranges::fill(awake_, std::uint8_t{1});
    untangling_ = sweep.untangling;
  }
  std::uint64_t visit(std::uint64_t first, std::uint64_t count, std::span<Vec3> positions, ThreadPool* pool) override {
    if (stale_) load(positions, pool);
    std::atomic<std::uint64_t> moved{0}, searched{0};
    stored_ = false;
    for_classes(*colouring_, first, count, [&](std::uint64_t from, std::uint64_t to) {
      wake_leaders();
      const auto chunk = [&](std::size_t begin, std::size_t end) {
        // Counts the vertices awake now, which will be visited: those of one class do not wake each other.
        const auto here = std::span(awake_).subspan(from + begin, end - begin);
        searched += untangling_.repair ? here.size() : static_cast<std::uint64_t>(std::ranges::count(here, std::uint8_t{1}));
        moved += untangling_.repair ? repair(from + begin, from + end) : kernel_(task_, from + begin, from + end);
      };
      for_chunks(pool, to - from, kLaneGrain, std::cref(chunk));  // passed by reference: a function object of this size would be allocated
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

  /// Sets the part of the task that does not change between visits.
  LaneTask describe(const SearchParameters& parameters) {
    LaneTask task{};
    task.shapes = table_.shapes.data();
    task.others = table_.others.data();
    task.ranked = ranked_.empty() ? nullptr : &ranked_[0].x;
    task.awake = awake_.data();
    task.frame = make_search_frame(*input_);
    task.parameters = parameters;
    task.targets = targets_.numbers.data();
    task.first_target = targets_.first.data();
    task.owner = this;
    task.guarded_above = guarded_above(alone_.guard());
    task.gains = [](void* owner, Index rank, double* p) {
      auto& self = *static_cast<LaneDmo*>(owner);
      thread_local Visit<Plane, Grid>::Scratch room;  // kept: stepping allocates nothing
      const auto target = self.alone_.confirmed(self.table_.vertex_of_rank[rank], {p[0], p[1], p[2]}, self.view(), room);
      if (target) p[0] = target->x, p[1] = target->y, p[2] = target->z;
      return target.has_value();
    };
    task.visit_alone = [](void* owner, Index rank) {
      auto& self = *static_cast<LaneDmo*>(owner);
      thread_local Visit<Plane, Grid>::Scratch room;  // kept: stepping allocates nothing
      const auto target = self.alone_.target(self.view(), self.table_.vertex_of_rank[rank], room);
      if (!target) return false;
      self.ranked_[rank] = *target;
      self.follow(rank);
      return true;
    };
    return task;
  }

  /// See LaneTask: kernels judge the mean ratio, and leave to the visit what rounding may decide.
  [[nodiscard]] static double guarded_above(const std::optional<Guard>& guard) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    if (!guard) return -kInfinity;
    if (guard->metric != Metric::MeanRatio) return kInfinity;
    return guard->floor + formulas::rank_doubt<Metric::MeanRatio>(guard->floor);
  }

  /// Moves the follower of a vertex along, and wakes its star.
  void follow(Index rank) {
    const Index vertex = table_.vertex_of_rank[rank], follower = pairs_ ? pairs_->follower(vertex) : kNoIndex;
    if (follower == kNoIndex) return;
    ranked_[table_.rank_of_vertex[follower]] = pairs_->place_of_follower(vertex, ranked_[rank]);
    for (const Incidence& at : input_->topology.star(follower))
      for (const Index other : input_->mesh.elements.corners(at.element)) wake(table_.rank_of_vertex[other]);
  }
  void wake(Index rank) { std::atomic_ref(awake_[rank]).store(1, std::memory_order_relaxed); }
  /// Wakes the leaders of followers that are awake.
  void wake_leaders() {
    if (!pairs_) return;
    for (const Partners& pair : pairs_->pairs())
      if (std::uint8_t& follower = awake_[table_.rank_of_vertex[pair.second]]; std::exchange(follower, std::uint8_t{0}) != 0)
        awake_[table_.rank_of_vertex[pair.first]] = 1;
  }

  /// Visits tangled stars alone: lanes are for sound stars, which wait.
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
  std::shared_ptr<const Domain> pairs_;  // null: none move together
  Visit<Plane, Grid> alone_;
  StarTable table_;
  StarTargets targets_;  // empty: ideal ones
  LaneKernel kernel_;
  std::vector<Vec3> ranked_;
  std::vector<std::uint8_t> awake_;
  LaneTask task_;
  bool stale_ = true;    // whether ranked_ is older than the run's positions
  bool stored_ = false;  // whether the run's positions are as new as ranked_
  std::uint64_t searched_ = 0;
  Untangling untangling_{};  // the rule by which vertices that sleep stay
};

}  // namespace dmoscope
