#pragma once
// What joint moves did to a run, iteration by iteration, so that an iteration done again has the same bits and takes no time.

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
  std::optional<JointCluster> cluster{};                  // none: there was nothing more to do
  bool anew = false;                                      // it knew nothing of those before it, because vertices had been moved otherwise
  std::size_t atom_count = 0, vertex_count = 0;           // of the state after it
  std::vector<std::pair<Index, JointState::Of>> atoms{};  // those that are something else than before it
  std::vector<std::pair<Index, double>> levels{};         // likewise of vertices
  JointState rest{};                                      // all else of the state after it; its vectors are empty
};

/// A state that came from elsewhere, at the end of an iteration.
struct JointStanding {
  std::uint64_t iteration = 0;
  JointState state;
};

/// Of a path, by iteration; null where nothing is known, as of iterations of other phases.
struct JointPath {
  SharedVector<std::shared_ptr<const JointIteration>> iterations{};
  std::shared_ptr<const JointStanding> standing{};  // null: there is none
};

class JointCourse {
 public:
  /// Null where it is not known.
  [[nodiscard]] std::shared_ptr<const JointIteration> find(std::uint64_t iteration) const;
  /// What the iteration after this one goes on from; none where too little is known. `since`: the iteration after which the phase began.
  [[nodiscard]] std::optional<JointState> state_after(std::uint64_t iteration, std::uint64_t since) const;
  /// Takes down an iteration that led from one state to another.
  void add(std::uint64_t iteration, const JointState& before, JointState after, std::optional<JointCluster> cluster, bool anew);

  /// What came after an iteration is of another path.
  void forget_after(std::uint64_t iteration);
  [[nodiscard]] JointPath share() const { return {iterations_.share(), standing_}; }
  /// Takes back what was forgotten of a path, or comes from elsewhere.
  void restore(const JointPath& path);

 private:
  GrowingVector<std::shared_ptr<const JointIteration>> iterations_;
  std::shared_ptr<const JointStanding> standing_;
  mutable std::optional<JointStanding> latest_;  // so that a walk need not go back to the begin for each
};

}  // namespace dmoscope
