#include "mpi/smooth/rank_share.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <utility>

#include "core/base/stopwatch.h"
#include "core/input/mesh_region.h"
#include "core/smooth/task.h"
#include "mpi/mesh/shared_winding.h"

namespace dmoscope {

std::uint64_t HaloPlan::bytes() const {
  std::uint64_t all = 0;
  for (const Exchange& one : classes) all += one.send.size() * sizeof(Vec3);
  return all;
}

HaloPlan make_halo_plan(const Halo& halo, std::span<const Index> colour, Index classes) {
  HaloPlan plan;
  plan.classes.resize(classes);
  for (const Halo::Neighbour& neighbour : halo.neighbours()) {
    for (HaloPlan::Exchange& one : plan.classes)
      one.neighbours.push_back({neighbour.rank, one.send.size(), one.send.size(), one.receive.size(), one.receive.size()});
    const auto add = [&](Index v, std::vector<Index> HaloPlan::Exchange::*list, std::uint64_t HaloPlan::Exchange::With::*end) {
      if (colour[v] >= classes) return;  // fixed
      HaloPlan::Exchange& one = plan.classes[colour[v]];
      (one.*list).push_back(v);
      one.neighbours.back().*end = (one.*list).size();
    };
    for (const Index v : neighbour.send) add(v, &HaloPlan::Exchange::send, &HaloPlan::Exchange::With::send_end);
    for (const Index v : neighbour.receive) add(v, &HaloPlan::Exchange::receive, &HaloPlan::Exchange::With::receive_end);
    for (HaloPlan::Exchange& one : plan.classes) {
      const auto& with = one.neighbours.back();
      if (with.send_begin == with.send_end && with.receive_begin == with.receive_end) one.neighbours.pop_back();
    }
  }
  return plan;
}

namespace {

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

class HaloSmoother final : public Smoother {
 public:
  HaloSmoother(const World& world, const HaloPlan& plan, std::unique_ptr<Smoother> here, std::shared_ptr<const Colouring> colouring,
               HaloCost& cost)
      : world_(world), plan_(plan), here_(std::move(here)), colouring_(std::move(colouring)), cost_(cost) {}

  void begin(const Sweep& sweep) override { here_->begin(sweep); }
  /// Visits vertices; the ranks' classes end in the same order everywhere, however a rank cuts its iteration into calls.
  std::uint64_t visit(std::uint64_t first, std::uint64_t count, std::span<Vec3> positions, ThreadPool* pool) override {
    const std::uint64_t last = first + count, whole = colouring_->order.size(), parts = 2 * plan_.classes.size();
    if (first == 0) {
      part_ = told_ = 0;
      searched_before_ = here_->searched();
      static_cast<void>(here_->visit(0, 0, positions, pool));  // tells the smoother the positions, even if it visits no vertex
    }
    std::uint64_t moved = 0;
    for (std::uint64_t at = first; part_ < parts; ++part_) {
      const std::uint64_t end = colouring_->class_offsets[part_ + 1], stop = std::min(end, last);
      if (stop > at) moved += visit_here(at, stop - at, positions, pool);
      at = std::max(at, stop);
      if (at < end || (at == last && last < whole)) break;
      end_part(positions);
    }
    told_ += moved;
    if (last < whole) return moved;
    return end_iteration() - (told_ - moved);
  }
  [[nodiscard]] std::optional<std::uint64_t> searched() const noexcept override { return searched_; }
  void store(std::span<Vec3> positions, ThreadPool* pool) override { here_->store(positions, pool); }
  void positions_replaced() override { here_->positions_replaced(); }

 private:
  static constexpr int kTag = 31;

  /// Ends a part of a class: after the first the shared vertices are sent, after the second those of others are awaited, with work in
  /// between.
  void end_part(std::span<Vec3> positions) {
    const HaloPlan::Exchange& exchange = plan_.classes[part_ / 2];
    if (exchange.neighbours.empty()) return;
    const Stopwatch watch;
    if (part_ % 2 == 0)
      send(exchange, positions);
    else
      receive(exchange, positions);
    cost_.waiting += watch.seconds();
  }
  std::uint64_t visit_here(std::uint64_t first, std::uint64_t count, std::span<Vec3> positions, ThreadPool* pool) {
    const double before = processor_seconds();
    const std::uint64_t moved = here_->visit(first, count, positions, pool);
    cost_.visiting += processor_seconds() - before;
    return moved;
  }
  void send(const HaloPlan::Exchange& exchange, std::span<const Vec3> positions) {
    sent_.resize(exchange.send.size());
    came_.resize(exchange.receive.size());
    here_->give(exchange.send, positions, sent_);
    const auto bytes = [](std::uint64_t begin, std::uint64_t end) { return static_cast<int>((end - begin) * sizeof(Vec3)); };
    for (const auto& with : exchange.neighbours) {
      if (with.receive_begin < with.receive_end)
        MPI_Irecv(&came_[with.receive_begin], bytes(with.receive_begin, with.receive_end), MPI_BYTE, with.rank, kTag, world_.comm(),
                  &requests_.emplace_back());
      if (with.send_begin < with.send_end)
        MPI_Isend(&sent_[with.send_begin], bytes(with.send_begin, with.send_end), MPI_BYTE, with.rank, kTag, world_.comm(),
                  &requests_.emplace_back());
    }
  }
  void receive(const HaloPlan::Exchange& exchange, std::span<Vec3> positions) {
    MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
    requests_.clear();
    here_->take(exchange.receive, came_, positions);
  }
  /// Returns how many vertices moved on all ranks.
  std::uint64_t end_iteration() {
    const auto searched = here_->searched();
    std::array<std::uint64_t, 3> all{told_, searched && searched_before_ ? *searched - *searched_before_ : 0, searched ? 0U : 1U};
    world_.sum(all);
    searched_ = searched_ && all[2] == 0 ? std::optional(*searched_ + all[1]) : std::nullopt;
    return all[0];
  }

  World world_;
  const HaloPlan& plan_;
  std::unique_ptr<Smoother> here_;
  std::shared_ptr<const Colouring> colouring_;
  HaloCost& cost_;
  std::uint64_t part_ = 0, told_ = 0;  // the present part of the iteration, and moves that the caller knows of
  std::optional<std::uint64_t> searched_ = 0, searched_before_;
  std::vector<Vec3> sent_, came_;
  std::vector<MPI_Request> requests_;
};

}  // namespace

std::unique_ptr<Smoother> make_halo_smoother(const World& world, const HaloPlan& plan, std::unique_ptr<Smoother> here,
                                             std::shared_ptr<const Colouring> colouring, HaloCost& cost) {
  return std::make_unique<HaloSmoother>(world, plan, std::move(here), std::move(colouring), cost);
}

RankShare::RankShare(const World& world, Share share)
    : world_(world), share_(std::move(share)), halo_(world, share_), statistics_(world, share_) {}

std::vector<std::string> RankShare::all_of(const std::string& here) const {
  std::vector<std::string> all(static_cast<std::size_t>(world_.size()), here);
  for (int rank = 0; rank < world_.size(); ++rank) world_.broadcast(all[static_cast<std::size_t>(rank)], rank);
  return all;
}

void RankShare::join(RegionParts& parts) const {
  const auto on_all = [this](auto& values) {
    values = world_.gather(values);
    world_.broadcast(values, 0);
  };
  on_all(parts.vertices);
  on_all(parts.elements);
}

Index RankShare::orient(Mesh& mesh, const Geometry& geometry, const Topology& topology, const FaceNeighbours* faces) const {
  return orient_share(world_, share_, mesh, geometry, topology, faces);
}

Colouring RankShare::colour(const Mesh& mesh, const Geometry& geometry, const Topology& topology, std::span<const std::uint8_t> fixed,
                            ThreadPool* pool) const {
  colours_ = colour_shares(world_, share_, halo_, mesh, topology, fixed);
  plan_ = make_halo_plan(halo_, colours_.of_vertex, colours_.classes);
  std::vector<std::uint8_t> awaited(share_.vertices.size(), 0);
  for (const Halo::Neighbour& neighbour : halo_.neighbours())
    for (const Index v : neighbour.send) awaited[v] = 1;
  // Counting sort by class; within a class, vertices that others wait for come first.
  Colouring colouring;
  colouring.class_offsets.assign(2 * std::size_t{colours_.classes} + 1, 0);
  const auto part = [&](Index v) { return 2 * std::size_t{colours_.of_vertex[v]} + (awaited[v] != 0 ? 0U : 1U); };
  const auto each = [&](const auto& visit) {
    for (Index v = 0; v < fixed.size(); ++v)
      if (fixed[v] == 0 && owns(v)) visit(v);
  };
  each([&](Index v) { ++colouring.class_offsets[part(v) + 1]; });
  for (std::size_t c = 1; c < colouring.class_offsets.size(); ++c) colouring.class_offsets[c] += colouring.class_offsets[c - 1];
  colouring.order.resize(colouring.class_offsets.back());
  std::vector<Index> next(colouring.class_offsets.begin(), colouring.class_offsets.end() - 1);
  each([&](Index v) { colouring.order[next[part(v)]++] = v; });
  arrange_classes(colouring, mesh, geometry.shape == Shape::Volume ? nullptr : &geometry.plane, topology, pool);
  return colouring;
}

std::unique_ptr<Smoother> RankShare::among_others(std::unique_ptr<Smoother> here, const SmoothingTask& task) const {
  return make_halo_smoother(world_, plan_, std::move(here), task.colouring, cost_);
}

Statistics RankShare::statistics(const QualityContext& context, std::span<const Vec3> positions, Metric metric,
                                 std::span<const Index> immovable, ThreadPool* pool) const {
  return statistics_.of(context, positions, metric, immovable, pool);
}

}  // namespace dmoscope
