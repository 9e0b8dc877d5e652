#include "core/inspect/joint_hold.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/quality/quality.h"

namespace dmoscope {

std::optional<JointCluster> joint_hold(const InputMesh& input, std::span<const Vec3> positions, std::span<const std::uint8_t> fixed,
                                       JointSliding sliding, const JointObjective& aims, std::size_t at_most, ThreadPool* pool,
                                       Progress& progress, const std::function<bool()>& go_on) {
  if (!why_not_joint(input, aims).empty()) return std::nullopt;
  JointOptions options;
  options.whole_at_most = options.cluster_at_most = options.push_at_most = at_most;
  options.pool = pool;
  if (go_on)
    options.on_step = [&go_on](const JointStep&) {
      if (!go_on()) throw Cancelled();
    };
  std::vector<Vec3> copy(positions.begin(), positions.end());
  JointState state;
  auto cluster = JointClusters(input, aims, fixed, std::move(sliding)).raise_worst(copy, state, options, progress);
  return cluster && cluster->worst_element != kNoIndex ? std::move(cluster) : std::nullopt;
}

std::span<const JointCluster::Active> holders(const JointCluster& cluster) {
  constexpr double kNearlyAll = 0.99;
  double sum = 0.0;
  std::size_t count = 0;
  while (count < cluster.active.size() && sum < kNearlyAll) sum += cluster.active[count++].multiplier;
  return std::span(cluster.active).first(count);
}

std::string certificate_sentence(const JointCluster& cluster) {
  constexpr std::size_t kNamed = 5;
  const std::string what = cluster.aim.empty() ? "it" : cluster.aim;
  if (!cluster.certified) return fmt::format("Whether joint moves raise {} is not certain: {}.", what, cluster.why_not);
  const auto all = holders(cluster);
  std::string text = fmt::format("Certified: no joint move raises {}, to first order.", what);
  if (all.size() < 2) return text;
  text += fmt::format(" {} elements hold one another", all.size());
  constexpr double kWorthNaming = 0.005;
  if (all[0].multiplier < kWorthNaming) return text + ", each with less than 1 %.";
  text += ':';
  for (std::size_t i = 0; i < std::min(all.size(), kNamed); ++i)
    text += fmt::format("{} {} ({:.0f} %)", i > 0 ? "," : "", all[i].element, 100.0 * all[i].multiplier);
  return text + (all.size() > kNamed ? ", …" : ".");
}

}  // namespace dmoscope
