#pragma once
// Rules that move one vertex after the other, on the CPU and in double, and their smoother.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <concepts>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/memory.h"
#include "core/reference/domain.h"
#include "core/smooth/reference_visit.h"
#include "core/smooth/smoother.h"

namespace dmoscope {

[[nodiscard]] inline bool is_finite(Vec2<double> a) { return std::isfinite(a.x) && std::isfinite(a.y); }
[[nodiscard]] inline bool is_finite(Vec3 a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

/// Mesh as a rule needs it. Frame: Plane or Space.
template <class Frame>
struct RuleMesh {
  using Offset = OffsetIn<Frame, double>;
  explicit RuleMesh(const InputMesh& input) : view(input.view<Frame>()), single(input.mesh.single_precision) {}
  MeshView<Frame> view;
  bool single;  // see Mesh::single_precision
  Untangling untangling{};

  /// Position of a vertex at `place` after an offset in mesh units; none where that is no number.
  [[nodiscard]] std::optional<Vec3> moved(Vec3 place, Offset offset) const {
    if (!is_finite(offset)) return std::nullopt;
    return displaced(view.frame, place, offset, single);
  }
  /// Position after the longest step that confirm(place) allows: see confirmed_move().
  template <class Confirm>
  [[nodiscard]] std::optional<Vec3> moved_if(Vec3 place, Offset step, const Confirm& confirm) const {
    if (!is_finite(step)) return std::nullopt;
    const ConfirmedMove move = confirmed_move(
        step, [&](Offset by) { return displaced(view.frame, place, by, single); }, confirm);
    return move.gains ? std::optional(move.to) : std::nullopt;
  }
};

/// Calls body(begin, end) for the part of [first, first + count) that lies in each class.
template <class Body>
void for_classes(const Colouring& colouring, std::uint64_t first, std::uint64_t count, const Body& body) {
  const std::uint64_t last = first + count;
  auto next = std::ranges::upper_bound(colouring.class_offsets, first);
  for (std::uint64_t end = first; first < last; first = end, ++next) {
    end = std::min<std::uint64_t>(*next, last);
    body(first, end);
  }
}

/// Rule that tells the place to which one vertex goes, from the positions alone and, if it has a begin(const Sweep&), the iteration. None:
/// it stays. The target depends only on the positions of the star's vertices and on Sweep::untangling, so that a vertex that stayed is not
/// visited again until a vertex of its star moves. Rule::Scratch is its work space, kept from one vertex to the next; no result may depend
/// on its content. A rule may also have
/// - static constexpr bool kDependsOnIteration = true: the target also depends on Sweep::iteration, and no vertex is passed over;
/// - others(Index vertex): the other vertices of its star, or none where it has not noted them;
/// - static constexpr std::size_t kGrain: number of vertices that a thread takes at once, if not 128.
template <class Rule>
concept VertexRule = requires(const Rule& rule, PositionView positions, Index vertex, typename Rule::Scratch& scratch) {
  { rule.target(positions, vertex, scratch) } -> std::same_as<std::optional<Vec3>>;
};

/// Number of vertices in a chunk: work of some 0.1 ms.
template <VertexRule Rule>
[[nodiscard]] constexpr std::size_t grain_of() {
  if constexpr (requires { Rule::kGrain; }) return Rule::kGrain;
  return 128;
}

/// Applies a rule class after class, by many threads.
template <VertexRule Rule>
class RuleSmoother final : public Smoother {
 public:
  RuleSmoother(const SmoothingTask& task, Rule rule)
      : input_(task.input), colouring_(task.colouring), pairs_(task.domain), rule_(std::move(rule)) {
    if (pairs_ && pairs_->pairs().empty()) pairs_.reset();
    if constexpr (kSleeps) awake_ = large_vector<std::uint8_t>(input_->mesh.positions.size());
    positions_replaced();
    begin({});
  }

  void begin(const Sweep& sweep) override {
    if constexpr (requires { rule_.begin(sweep); }) rule_.begin(sweep);
    if (sweep.untangling != untangling_) std::ranges::fill(awake_, std::uint8_t{1});
    untangling_ = sweep.untangling;
  }
  std::uint64_t visit(std::uint64_t first, std::uint64_t count, std::span<Vec3> positions, ThreadPool* pool) override {
    std::atomic<std::uint64_t> moved{0}, searched{0};
    for_classes(*colouring_, first, count, [&](std::uint64_t from, std::uint64_t to) {
      const auto vertices = std::span(colouring_->order).subspan(from, to - from);
      for_chunks(pool, vertices.size(), grain_of<Rule>(), [&](std::size_t begin, std::size_t end) {
        thread_local typename Rule::Scratch room;  // kept: stepping allocates nothing
        std::uint64_t here = 0, passed_over = 0;
        for (const Index vertex : vertices.subspan(begin, end - begin)) here += visit(vertex, positions, room, passed_over) ? 1U : 0U;
        moved += here;
        searched += end - begin - passed_over;
      });
    });
    searched_ += searched;
    return moved;
  }
  [[nodiscard]] std::optional<std::uint64_t> searched() const noexcept override { return searched_; }
  void store(std::span<Vec3> /*positions*/, ThreadPool* /*pool*/) override {}  // they are always up to date
  void positions_replaced() override { std::ranges::fill(awake_, std::uint8_t{1}); }
  void give(std::span<const Index> vertices, std::span<const Vec3> positions, std::span<Vec3> places) const override {
    for (std::size_t i = 0; i < vertices.size(); ++i) places[i] = positions[vertices[i]];
  }
  void take(std::span<const Index> vertices, std::span<const Vec3> places, std::span<Vec3> positions) override {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      Vec3& here = positions[vertices[i]];
      if (here == places[i]) continue;
      here = places[i];
      if constexpr (kSleeps) wake_star(vertices[i]);
    }
  }

 private:
  static constexpr bool kSleeps = !requires { requires Rule::kDependsOnIteration; };

  bool visit(Index vertex, std::span<Vec3> positions, typename Rule::Scratch& room, [[maybe_unused]] std::uint64_t& passed_over) {
    if constexpr (kSleeps) {
      if (awake_[vertex] == 0) {
        ++passed_over;
        return false;
      }
    }
    const std::optional<Vec3> target = rule_.target(positions, vertex, room);
    if (!target || *target == positions[vertex]) {
      if constexpr (kSleeps) awake_[vertex] = 0;
      return false;
    }
    positions[vertex] = *target;
    if constexpr (kSleeps) wake_around(vertex);
    if (const Index follower = pairs_ ? pairs_->follower(vertex) : kNoIndex; follower != kNoIndex) {
      positions[follower] = pairs_->place_of_follower(vertex, *target);
      if constexpr (kSleeps) wake_star(follower);
    }
    return true;
  }
  /// Wakes the vertices around one that moved. Vertices of one class have no element in common, but may have a neighbour.
  void wake_around(Index vertex) {
    if constexpr (requires { rule_.others(vertex); }) {
      const std::span<const Index> others = rule_.others(vertex);
      for (const Index other : others) wake(other);
      if (!others.empty()) return wake(vertex);
    }
    wake_star(vertex);
  }
  void wake_star(Index vertex) {
    for (const Incidence& at : input_->topology.star(vertex))
      for (const Index other : input_->mesh.elements.corners(at.element)) wake(other);
  }
  void wake(Index vertex) {
    const Index leader = pairs_ ? pairs_->leader(vertex) : kNoIndex;
    std::atomic_ref(awake_[leader == kNoIndex ? vertex : leader]).store(1, std::memory_order_relaxed);
  }

  std::shared_ptr<const InputMesh> input_;  // read by the rule
  std::shared_ptr<const Colouring> colouring_;
  std::shared_ptr<const Domain> pairs_;  // null: none move together
  Rule rule_;
  std::vector<std::uint8_t> awake_;  // by vertex; 0: it sleeps
  Untangling untangling_{};          // the rule by which vertices that sleep stay
  std::uint64_t searched_ = 0;
};

template <VertexRule Rule>
[[nodiscard]] std::unique_ptr<Smoother> make_rule_smoother(const SmoothingTask& task, Rule rule) {
  return std::make_unique<RuleSmoother<Rule>>(task, std::move(rule));
}

}  // namespace dmoscope
