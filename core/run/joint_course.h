#pragma once
// Record of a run's joint moves, iteration by iteration, so that an iteration done again has the same bits and takes no time.

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/shared_vector.h"
#include "core/joint/joint_clusters.h"

namespace dmoscope {

/// One iteration: a cluster, and what later ones must know of it.
struct JointIteration {
  std::optional<JointCluster> cluster{};         // none: there was nothing more to do
  bool anew = false;                             // it knew nothing of the iterations before it, because vertices had been moved otherwise
  std::size_t atom_count = 0, vertex_count = 0;  // sizes of the state after it
  std::vector<std::pair<Index, JointState::Of>> atoms{};  // atoms whose entry differs from the one before the iteration
  std::vector<std::pair<Index, double>> levels{};         // vertices whose level differs from the one before the iteration
  JointState rest{};                                      // rest of the state after it; its vectors are empty
};

/// State that came from elsewhere, at the end of an iteration.
struct JointStanding {
  std::uint64_t iteration = 0;
  JointState state;
};

/// Joint moves of a path, by iteration; null where nothing is known, as for iterations of other phases.
struct JointPath {
  SharedVector<std::shared_ptr<const JointIteration>> iterations{};
  std::shared_ptr<const JointStanding> standing{};  // null: there is none
};

class JointCourse {
 public:
  /// Joint move of an iteration; null where it is not known.
  [[nodiscard]] std::shared_ptr<const JointIteration> find(std::uint64_t iteration) const;
  /// State that the iteration after this one goes on from; none where too little is known. `since`: the iteration after which the phase
  /// began.
  [[nodiscard]] std::optional<JointState> state_after(std::uint64_t iteration, std::uint64_t since) const;
  /// Records an iteration that led from one state to another.
  void add(std::uint64_t iteration, const JointState& before, JointState after, std::optional<JointCluster> cluster, bool anew);

  /// Forgets the iterations after this one, which belong to another path.
  void forget_after(std::uint64_t iteration);
  [[nodiscard]] JointPath share() const { return {iterations_.share(), standing_}; }
  /// Takes back forgotten iterations of a path, or those that come from elsewhere.
  void restore(const JointPath& path);

 private:
  GrowingVector<std::shared_ptr<const JointIteration>> iterations_;
  std::shared_ptr<const JointStanding> standing_;
  mutable std::optional<JointStanding> latest_;  // last state asked for, so that a walk need not go back to the begin for each
};

}  // namespace dmoscope
