#pragma once
// Joint moves of the worst element, tried on a copy of the positions.

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "core/joint/joint_clusters.h"

namespace dmoscope {

/// Solves the cluster around the worst element that joint moves can change, of a mesh without inverted ones. None if joint moves are
/// impossible (see require_joint), or if there is no such element. `fixed`: one entry for each vertex. `at_most`: number of vertices of the
/// cluster; 0: as many as in a run. `pool` may be null. Throws Cancelled, also once `go_on`, which is asked after every Newton step,
/// returns false.
[[nodiscard]] std::optional<JointCluster> joint_hold(const InputMesh& input, std::span<const Vec3> positions,
                                                     std::span<const std::uint8_t> fixed, JointSliding sliding, const JointObjective& aims,
                                                     std::size_t at_most, ThreadPool* pool, Progress& progress,
                                                     const std::function<bool()>& go_on);

/// Sentence on a cluster that could not be raised: "Certified: no joint move raises it, to first order. 5 elements hold one another: 12 (40
/// %), 7 (31 %), ..." or why that is not certain.
[[nodiscard]] std::string certificate_sentence(const JointCluster& cluster);

/// The holders: the fewest elements that have nearly all of the multipliers.
[[nodiscard]] std::span<const JointCluster::Active> holders(const JointCluster& cluster);

}  // namespace dmoscope
