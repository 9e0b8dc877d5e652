#include "core/smooth/solid_dmo.h"

#include <atomic>
#include <utility>

#include "core/base/memory.h"
#include "core/smooth/solid_kernel.h"
#include "core/smooth/vertex_rule.h"

namespace dmoscope {

namespace {

/// A star in both precisions.
struct Room {
  SolidStar<double> exact;
  SolidStar<float> fast;
};

Vec3Of<float> narrow(Vec3 p) { return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)}; }

StarTetrahedron<float> narrow(const StarTetrahedron<double>& t) { return {narrow(t.b), narrow(t.c), narrow(t.d), 1.0F}; }
StarTip<float> narrow(const StarTip<double>& t) {
  return {{narrow(t.base[0]), narrow(t.base[1]), narrow(t.base[2]), narrow(t.base[3])}, 1.0F};
}
template <class Narrow, class Solid, std::size_t N>
Narrow narrow_others(const StarSolid<Solid, N, double>& s) {
  Narrow result{};
  for (std::size_t i = 0; i < N; ++i) result.others[i] = narrow(s.others[i]);
  result.reference = 1.0F;
  return result;
}
StarHexahedron<float> narrow(const StarHexahedron<double>& h) { return narrow_others<StarHexahedron<float>>(h); }
StarWedge<float> narrow(const StarWedge<double>& w) { return narrow_others<StarWedge<float>>(w); }
StarPyramid<float> narrow(const StarPyramid<double>& p) { return narrow_others<StarPyramid<float>>(p); }

template <class From, class To>
ListView<To> narrow_list(const std::vector<From>& from, std::vector<To>& to) {
  to.clear();
  for (const From& element : from) to.push_back(narrow(element));
  return {to.data(), to.size()};
}

/// The fast search for a vertex, and the plain one where the fast one cannot speak for its star: elements that are inverted or nearly, or
/// too many.
template <Metric M>
class FastSearch {
 public:
  FastSearch(const SmoothingTask& task)  // NOLINT(google-explicit-constructor)
      : mesh_(*task.input), parameters_(task.search), kernel_(solid_kernel(task.search.simd.value_or(best_simd_level()), M)) {}

  std::optional<Vec3> target(PositionView positions, Index vertex, Room& room) const {
    const MeshStar star(mesh_.view, positions, vertex);
    gather_star(star, room.exact);
    const SolidFound found = fits(room.exact) ? kernel_(search_of(room)) : SolidFound{};
    if (!found.ready) return target_by_plain_search(positions, vertex, room.exact);
    const Vec3 offset{found.offset.x, found.offset.y, found.offset.z};
    if (offset == Vec3{}) return std::nullopt;
    return mesh_.template moved_if_gaining<M>(positions, vertex, offset, room.exact.scale);
  }

  const VolumeView& view() const { return mesh_.view; }

 private:
  static bool fits(SolidStar<double>& star) {
    bool fits = true;
    star.for_each_list([&fits](const auto& list) { fits = fits && list.size() <= kMaxSolids; });
    return fits;
  }

  [[nodiscard]] SolidSearch search_of(Room& room) const {
    SolidSearch search;
    search.tetrahedra = narrow_list(room.exact.tetrahedra, room.fast.tetrahedra);
    search.hexahedra = narrow_list(room.exact.hexahedra, room.fast.hexahedra);
    search.wedges = narrow_list(room.exact.wedges, room.fast.wedges);
    search.pyramids = narrow_list(room.exact.pyramids, room.fast.pyramids);
    search.tips = narrow_list(room.exact.tips, room.fast.tips);
    search.box = narrow(room.exact.box);
    search.points = parameters_.grid_points;
    search.levels = parameters_.levels;
    search.omega = parameters_.omega;
    return search;
  }

  std::optional<Vec3> target_by_plain_search(PositionView positions, Index vertex, const SolidStar<double>& star) const {
    const Vec3 found = search_star<M>(SolidStarView<double>(star), star.box, parameters_);
    if (found == Vec3{}) return std::nullopt;
    return mesh_.template moved_if_gaining<M>(positions, vertex, found, star.scale);
  }

  RuleMesh<Space> mesh_;
  SearchParameters parameters_;
  SolidKernel kernel_;
};

/// Visits class after class, and passes over vertices of whose star nothing has moved since they were last found at their best.
template <Metric M>
class SolidDmo final : public Smoother {
 public:
  explicit SolidDmo(const SmoothingTask& task)
      : input_(task.input),
        colouring_(task.colouring),
        search_(task),
        awake_(large_vector<std::uint8_t>(task.input->mesh.positions.size())) {
    positions_replaced();
  }

  std::uint64_t visit(std::uint64_t first, std::uint64_t count, std::span<Vec3> positions, ThreadPool* pool) override {
    std::atomic<std::uint64_t> moved{0};
    for_classes(*colouring_, first, count, [&](std::uint64_t from, std::uint64_t to) {
      const auto vertices = std::span(colouring_->order).subspan(from, to - from);
      for_chunks(pool, vertices.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        thread_local Room room;  // kept: stepping allocates nothing
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

  bool visit(Index vertex, std::span<Vec3> positions, Room& room) {
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
  FastSearch<M> search_;
  std::vector<std::uint8_t> awake_;  // by vertex
};

}  // namespace

std::unique_ptr<Smoother> make_solid_dmo_smoother(const SmoothingTask& task) {
  return formulas::with_solid_metric(task.metric,
                                     [&]<Metric M>() -> std::unique_ptr<Smoother> { return std::make_unique<SolidDmo<M>>(task); });
}

}  // namespace dmoscope
