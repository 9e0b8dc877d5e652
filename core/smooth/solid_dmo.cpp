#include "core/smooth/solid_dmo.h"

#include <atomic>
#include <utility>

#include "core/base/memory.h"
#include "core/smooth/fast_solid_search.h"

namespace dmoscope {

namespace {

/// Visits class after class, and passes over vertices of whose star nothing has moved since they were last found at their best.
template <Metric M>
class SolidDmo final : public Smoother {
 public:
  explicit SolidDmo(const SmoothingTask& task)
      : input_(task.input),
        colouring_(task.colouring),
        search_(*task.input, task.search),
        awake_(large_vector<std::uint8_t>(task.input->mesh.positions.size())) {
    positions_replaced();
  }

  std::uint64_t visit(std::uint64_t first, std::uint64_t count, std::span<Vec3> positions, ThreadPool* pool) override {
    std::atomic<std::uint64_t> moved{0};
    for_classes(*colouring_, first, count, [&](std::uint64_t from, std::uint64_t to) {
      const auto vertices = std::span(colouring_->order).subspan(from, to - from);
      for_chunks(pool, vertices.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        thread_local SolidRoom room;  // kept: stepping allocates nothing
        std::uint64_t here = 0;
        for (const Index vertex : vertices.subspan(begin, end - begin)) here += visit(vertex, positions, room) ? 1U : 0U;
        moved += here;
      });
    });
    return moved;
  }
  void store(std::span<Vec3> /*positions*/, ThreadPool* /*pool*/) override {}  // they are always up to date
  void positions_replaced() override { std::ranges::fill(awake_, std::uint8_t{1}); }

 private:
  static constexpr std::size_t kGrain = 128;

  bool visit(Index vertex, std::span<Vec3> positions, SolidRoom& room) {
    if (awake_[vertex] == 0) return false;
    const std::optional<Vec3> target = search_.target(positions, vertex, room);
    if (!target || *target == positions[vertex]) {
      awake_[vertex] = 0;
      return false;
    }
    positions[vertex] = *target;
    // Vertices of one class have no element in common, but may have a neighbour.
    for (const Incidence& at : search_.view().star(vertex))
      for (const Index other : search_.view().corners_of(at.element)) std::atomic_ref(awake_[other]).store(1, std::memory_order_relaxed);
    return true;
  }

  std::shared_ptr<const InputMesh> input_;
  std::shared_ptr<const Colouring> colouring_;
  FastSolidSearch<M> search_;
  std::vector<std::uint8_t> awake_;  // by vertex
};

}  // namespace

std::unique_ptr<Smoother> make_solid_dmo_smoother(const SmoothingTask& task) {
  return formulas::with_solid_metric(task.metric,
                                     [&]<Metric M>() -> std::unique_ptr<Smoother> { return std::make_unique<SolidDmo<M>>(task); });
}

}  // namespace dmoscope
