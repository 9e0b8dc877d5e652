#include "core/joint/joint_clusters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/joint/cluster_search.h"
#include "core/joint/untangler.h"

namespace dmoscope {

namespace {

/// Marks the vertices that joint moves keep in place: fixed ones, pairs, which such moves would part, and on a curved surface all that do
/// not slide.
std::vector<std::uint8_t> held(const InputMesh& input, std::span<const std::uint8_t> fixed, const Domain* domain) {
  std::vector<std::uint8_t> result(fixed.begin(), fixed.end());
  for (Index v = 0; input.is_surface() && v < result.size(); ++v)
    if (domain == nullptr || !domain->slides(v)) result[v] = 1;
  for (const Partners& pair : domain != nullptr ? domain->pairs() : std::span<const Partners>())
    result[pair.first] = result[pair.second] = 1;
  return result;
}

template <int D>
std::optional<JointCluster> untangle_all(const InputMesh& input, Metric metric, const std::vector<std::uint8_t>& fixed,
                                         const JointSliding& sliding, std::span<Vec3> positions, const JointOptions& options,
                                         Progress& progress) {
  JointState state;
  const JointMesh<D> by_mean_ratio(input, Metric::MeanRatio, fixed);
  return Untangler<D>(by_mean_ratio, metric, sliding, positions, state, options, progress).run();
}

}  // namespace

std::optional<JointCluster> untangle(const InputMesh& input, Metric metric, std::span<const std::uint8_t> fixed,
                                     const JointSliding& sliding, std::span<Vec3> positions, const JointOptions& options,
                                     Progress& progress) {
  if (input.is_surface()) return std::nullopt;
  const std::vector<std::uint8_t> stays = held(input, fixed, sliding.domain.get());
  return input.is_volume() ? untangle_all<3>(input, metric, stays, sliding, positions, options, progress)
                           : untangle_all<2>(input, metric, stays, sliding, positions, options, progress);
}

class JointClusters::Base {
 public:
  Base() = default;
  Base(const Base&) = delete;
  Base& operator=(const Base&) = delete;
  virtual ~Base() = default;
  virtual std::optional<JointCluster> raise_worst(std::span<Vec3> positions, JointState& state, const JointOptions& options,
                                                  Progress& progress) const = 0;
  [[nodiscard]] virtual std::size_t free_vertices() const noexcept = 0;
  [[nodiscard]] virtual bool fits(const JointState& state) const noexcept = 0;
};

template <int D>
class JointClusters::Of final : public Base {
 public:
  Of(const InputMesh& input, const JointObjective& aims, const std::vector<std::uint8_t>& fixed, JointSliding sliding)
      : mesh_(input, aims.metric, fixed), sliding_(std::move(sliding)) {
    if (!aims.combination) return;
    threshold_ = aims.combination->threshold;
    second_.emplace(input, std::get<Metric>(aims.combination->second), fixed);
  }
  std::optional<JointCluster> raise_worst(std::span<Vec3> positions, JointState& state, const JointOptions& options,
                                          Progress& progress) const override {
    JointState next = state;
    if (std::optional<JointCluster> untangled = untangle(positions, next, options, progress)) {
      state = std::move(next);
      return untangled;
    }
    std::optional<JointCluster> result;
    if (!next.beyond) result = ClusterSearch<D>(mesh_, threshold_, nullptr, sliding_, positions, next, options, progress).run();
    if (!result && second_) {
      if (!next.beyond) next = {.clusters = next.clusters, .untanglings = next.untanglings, .beyond = true};
      result = ClusterSearch<D>(*second_, threshold_, &mesh_, sliding_, positions, next, options, progress).run();
    }
    state = std::move(next);
    return result;
  }
  [[nodiscard]] std::size_t free_vertices() const noexcept override { return mesh_.free_vertices().size(); }
  [[nodiscard]] bool fits(const JointState& state) const noexcept override {
    if (state.beyond && !second_) return false;
    if (state.atoms.empty()) return state.levels.empty();
    const std::size_t atoms = (state.beyond ? *second_ : mesh_).atoms().size();
    return state.atoms.size() == atoms && state.levels.size() == mesh_.input().mesh.vertex_count();
  }

 private:
  std::optional<JointCluster> untangle(std::span<Vec3> positions, JointState& state, const JointOptions& options,
                                       Progress& progress) const {
    if (mesh_.input().is_surface()) return std::nullopt;
    if (mesh_.metric() == Metric::MeanRatio)
      return Untangler<D>(mesh_, Metric::MeanRatio, sliding_, positions, state, options, progress).run();
    std::vector<std::uint8_t> fixed(positions.size(), 1);
    for (const Index v : mesh_.free_vertices()) fixed[v] = 0;
    const JointMesh<D> by_mean_ratio(mesh_.input(), Metric::MeanRatio, fixed);
    return Untangler<D>(by_mean_ratio, mesh_.metric(), sliding_, positions, state, options, progress).run();
  }

  JointMesh<D> mesh_;
  std::optional<JointMesh<D>> second_;                          // atoms of the second aim; none: there is one aim
  double threshold_ = std::numeric_limits<double>::infinity();  // threshold of the first aim
  JointSliding sliding_;
};

std::string why_not_joint(const InputMesh& input, const JointObjective& aims) {
  const int dimension = input.is_volume() ? 3 : 2;
  KindSet kinds = 0;
  for (const ElementKind kind : input.mesh.elements.kinds())
    if (info(kind).dimension == dimension) kinds = static_cast<KindSet>(kinds | kind_set(kind));
  std::string obstacle = joint_obstacle(aims.metric, kinds);
  if (aims.combination && obstacle.empty()) {
    const auto* second = std::get_if<Metric>(&aims.combination->second);
    obstacle = second != nullptr ? joint_obstacle(*second, kinds) : "the second of two aims can be a metric, but not density";
  }
  return obstacle.empty() ? obstacle : "joint moves: " + obstacle;
}

void require_joint(const InputMesh& input, const JointObjective& aims) {
  if (const std::string why_not = why_not_joint(input, aims); !why_not.empty()) throw UsageError(why_not);
}

JointClusters::JointClusters(const InputMesh& input, const JointObjective& aims, std::span<const std::uint8_t> fixed,
                             JointSliding sliding) {
  require_joint(input, aims);
  const std::vector<std::uint8_t> stays = held(input, fixed, sliding.domain.get());
  if (input.in_space())
    mesh_ = std::make_unique<Of<3>>(input, aims, stays, std::move(sliding));
  else
    mesh_ = std::make_unique<Of<2>>(input, aims, stays, std::move(sliding));
}
JointClusters::~JointClusters() = default;
JointClusters::JointClusters(JointClusters&&) noexcept = default;
JointClusters& JointClusters::operator=(JointClusters&&) noexcept = default;

std::optional<JointCluster> JointClusters::raise_worst(std::span<Vec3> positions, JointState& state, const JointOptions& options,
                                                       Progress& progress) {
  return mesh_->raise_worst(positions, state, options, progress);
}

std::size_t JointClusters::free_vertices() const noexcept { return mesh_->free_vertices(); }

bool JointClusters::fits(const JointState& state) const noexcept { return mesh_->fits(state); }

}  // namespace dmoscope
