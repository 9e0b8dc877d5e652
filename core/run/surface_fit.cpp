#include "core/run/surface_fit.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/rounding.h"
#include "core/base/same_bits.h"
#include "core/joint/joint_clusters.h"
#include "core/quality/quality.h"
#include "core/reference/domain.h"
#include "core/smooth/methods/dmo.h"
#include "core/smooth/smoother.h"

namespace dmoscope {

namespace {

constexpr int kMostRounds = 60, kPatience = 10, kHalvings = 4;
constexpr int kMostAttempts = 4;   // to untangle with vertices off the surface, half of them with those of a ring more
constexpr int kRings = 4;          // of elements around an inverted one that then move
constexpr double kReached = 1e-9;  // share of the mesh's size: a vertex so near its place is there

class SurfaceFit {
 public:
  SurfaceFit(const SmoothingTask& task, std::span<const std::uint8_t> fixed, double distance, std::span<Vec3> positions, Progress& progress)
      : task_(task),
        input_(*task.input),
        domain_(*task.domain),
        context_(input_.quality_context()),
        guard_(task.guard.value_or(Guard{Metric::MeanRatio, 0.0})),
        fixed_(fixed),
        distance_(distance),
        positions_(positions),
        progress_(progress) {}

  void fit() {
    const std::unique_ptr<Smoother> smoother = make_room_maker();
    bool rests = true;  // nothing was drawn in the last round
    for (int round = 0; round < kMostRounds; ++round) {
      progress_.check();
      progress_.set(static_cast<double>(round) / kMostRounds);
      const bool untangled = rests && untangle();
      const std::size_t pulled = pull();
      if (beside_ == 0 && !untangled && (rests || inverted_elements().empty())) return;
      if (rests && pulled == 0 && !untangled && round > kPatience) return;
      rests = pulled == 0;
      smoother->positions_replaced();
      smoother->begin({.iteration = static_cast<std::uint64_t>(round)});
      static_cast<void>(smoother->visit(0, task_.colouring->order.size(), positions_, task_.pool));
      smoother->store(positions_, task_.pool);
    }
    static_cast<void>(pull());
  }

 private:
  /// Smoother that raises elements between two rounds.
  [[nodiscard]] std::unique_ptr<Smoother> make_room_maker() const {
    SmoothingTask task = task_;
    task.method = "dmo";
    task.metric = Metric::MeanRatio;
    task.combination.reset();
    if (task.guard && task.guard->metric == task.metric) task.guard.reset();
    task.aim.reset();
    return make_dmo_smoother(task);
  }

  [[nodiscard]] std::vector<Index> inverted_elements() const {
    std::vector<Index> inverted;
    for (Index e = 0; e < input_.mesh.elements.size(); ++e)
      if (!is_sound(e)) inverted.push_back(e);
    return inverted;
  }

  /// Untangles with vertices that slide, and then, up to so many times, around each element that is left with its vertices let loose.
  /// Returns whether fewer are inverted.
  [[nodiscard]] bool untangle() {
    const std::vector<Index> inverted = inverted_elements();
    if (inverted.empty() || attempts_ == kMostAttempts) return false;
    untangle_by(fixed_, {task_.domain, task_.max_deviation});
    for (const Index e : inverted_elements())
      if (!is_sound(e)) untangle_loosely(e);
    ++attempts_;
    return inverted_elements().size() < inverted.size();
  }
  void untangle_by(std::span<const std::uint8_t> fixed, const JointSliding& sliding) {
    JointOptions options;
    options.pool = task_.pool;
    static_cast<void>(dmoscope::untangle(input_, Metric::MeanRatio, fixed, sliding, positions_, options, progress_));
  }
  [[nodiscard]] bool is_sound(Index element) const { return smallest_jacobian(context_, positions_, element) > 0.0; }

  /// Untangles an element with vertices that may leave the surface, by at most the distance; else nothing moves.
  void untangle_loosely(Index element) {
    std::vector<std::uint8_t> fixed(positions_.size(), 1), known(input_.mesh.elements.size(), 0);
    std::vector<Index> loose, ring{element};
    for (int rings = 0; rings <= kRings; ++rings) {
      std::vector<Index> next;
      for (const Index e : ring)
        for (const Index v : input_.mesh.elements.corners(e)) {
          const bool is_loose = domain_.on_surface(v) && !in_pair(v) && (rings == 0 || (rings == 1 && attempts_ >= kMostAttempts / 2));
          if (fixed[v] == 0 || fixed_[v] != 0 || (domain_.slides(v) && !is_loose)) continue;
          fixed[v] = 0;
          if (is_loose) loose.push_back(v);
        }
      for (const Index e : ring)
        for (const Index v : input_.mesh.elements.corners(e))
          for (const Incidence& at : input_.topology.star(v))
            if (!std::exchange(known[at.element], std::uint8_t{1})) next.push_back(at.element);
      ring = std::move(next);
    }
    const std::vector<Vec3> before(positions_.begin(), positions_.end());
    untangle_by(fixed, {});
    const auto strays = [&](Index v) { return length(*place_of(v) - positions_[v]) > distance_; };
    const auto drawn_back = [&](Index v) { return strays(v) && draw(v, *place_of(v)); };
    for (int sweep = 0; sweep < kMostRounds && std::ranges::count_if(loose, drawn_back) > 0; ++sweep) progress_.check();
    if (!is_sound(element) || std::ranges::any_of(loose, strays)) std::ranges::copy(before, positions_.begin());
  }
  [[nodiscard]] bool in_pair(Index v) const { return domain_.follower(v) != kNoIndex || domain_.leader(v) != kNoIndex; }

  /// Draws each vertex once, as far as it may go; returns how many moved.
  [[nodiscard]] std::size_t pull() {
    std::size_t moved = 0;
    beside_ = 0;
    for (Index v = 0; v < positions_.size(); ++v) {
      const std::optional<Vec3> place = place_of(v);
      const double near = kReached * input_.geometry.size;
      if (!place || !(length(*place - positions_[v]) > near)) continue;
      moved += draw(v, *place) ? 1 : 0;
      beside_ += length(*place - positions_[v]) > near ? 1 : 0;
    }
    return moved;
  }

  /// The nearest place on what a vertex belongs to.
  [[nodiscard]] std::optional<Vec3> place_of(Index v) const {
    const Vec3 here = positions_[v];
    if (const auto corner = domain_.corner(v))
      return length(*corner - here) <= distance_ ? std::optional(as_stored(*corner)) : std::nullopt;
    if (fixed_[v] != 0 || in_pair(v)) return std::nullopt;
    if (domain_.on_curve(v)) {
      const auto place = domain_.curves().place(v, here);
      return place ? std::optional(domain_.curves().at(v, *place)) : std::nullopt;
    }
    if (!domain_.on_surface(v)) return std::nullopt;
    const auto [facet, point] = domain_.faces().nearest(here, v);
    return as_stored(domain_.faces().facets().at({facet, point.weights}));
  }
  [[nodiscard]] Vec3 as_stored(Vec3 p) const {
    return input_.mesh.single_precision ? Vec3{nearest_float(p.x), nearest_float(p.y), nearest_float(p.z)} : p;
  }

  /// Goes the whole way to a place, or half of it and so on; false: it stays.
  [[nodiscard]] bool draw(Index v, Vec3 place) {
    const Vec3 here = positions_[v];
    const Star before = star(v);
    double share = 1.0;
    for (int i = 0; i <= kHalvings; ++i, share *= 0.5) {
      positions_[v] = share == 1.0 ? place : as_stored(here + share * (place - here));
      const Star after = star(v);
      const bool sound = after.inverted <= before.inverted && after.least_jacobian >= std::min(before.least_jacobian, 0.0);
      if (sound && after.least >= std::min(before.least, guard_.floor) && in_order(v)) return !same_bits(here, positions_[v]);
    }
    positions_[v] = here;
    return false;
  }
  /// Whether a vertex of a curve is between its neighbours there.
  [[nodiscard]] bool in_order(Index v) const {
    if (!domain_.on_curve(v)) return true;
    const auto place = domain_.curves().place(v, positions_[v]);
    return place && domain_.curves().neighbours(v, *place, positions_);
  }

  struct Star {
    double least = std::numeric_limits<double>::infinity(), least_jacobian = std::numeric_limits<double>::infinity();
    int inverted = 0;
  };
  [[nodiscard]] Star star(Index v) const {
    Star found;
    for (const Incidence& at : input_.topology.star(v)) {
      const double jacobian = smallest_jacobian(context_, positions_, at.element);
      found.least = std::min(found.least, element_quality(context_, positions_, guard_.metric, at.element));
      found.least_jacobian = std::min(found.least_jacobian, jacobian);
      found.inverted += jacobian > 0.0 ? 0 : 1;
    }
    return found;
  }

  const SmoothingTask& task_;
  const InputMesh& input_;
  const Domain& domain_;
  QualityContext context_;
  Guard guard_;
  std::span<const std::uint8_t> fixed_;
  double distance_;
  std::span<Vec3> positions_;
  Progress& progress_;
  int attempts_ = 0;        // see kMostAttempts
  std::size_t beside_ = 0;  // vertices that the last pull left beside the surface
};

}  // namespace

std::uint64_t fit_to_surface(const SmoothingTask& task, std::span<const std::uint8_t> fixed, double distance, std::span<Vec3> positions,
                             Progress& progress) {
  if (!task.domain) return 0;
  const std::vector<Vec3> before(positions.begin(), positions.end());
  SurfaceFit(task, fixed, distance, positions, progress).fit();
  std::uint64_t moved = 0;
  for (std::size_t v = 0; v < before.size(); ++v) moved += same_bits(before[v], positions[v]) ? 0 : 1;
  return moved;
}

}  // namespace dmoscope
