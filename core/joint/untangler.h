#pragma once
// Untangling by joint moves: one call of JointClusters::raise_worst that turns as many inverted elements the right way round as it can.
//
// Patches are the free vertices within some rings of elements around the inverted ones, each connected one a problem of its own, with its
// rim held. Elements that a patch leaves inverted are tried again with more rings, up to the whole mesh. A patch moves where it has fewer
// inverted elements than before and the least quality of the elements that it changed is no lower, by the program's own judgement.
// A call that ends with an element inverted that was sound is made again from its begin, and no patch may invert one then: elements
// that would be weigh more, and where that does not do, vertices around them stay.

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/joint/foldover_free.h"
#include "core/joint/joint_clusters.h"
#include "core/joint/joint_mesh.h"
#include "core/joint/sliding_path.h"

namespace dmoscope {

/// Untangler of one call. An exception may leave the state in any state; the positions are then as they were.
template <int D>
class Untangler {
 public:
  /// `mesh`: one by the mean ratio, whatever the metric is by which moves are judged.
  Untangler(const JointMesh<D>& mesh, Metric metric, const JointSliding& sliding, std::span<Vec3> positions, JointState& state,
            const JointOptions& options, Progress& progress);
  ~Untangler();  // takes back unfinished moves
  Untangler(const Untangler&) = delete;
  Untangler& operator=(const Untangler&) = delete;
  /// Untangles once. Returns none where nothing is inverted that could move, or nothing helps; the state says so, and it need not be asked
  /// again.
  [[nodiscard]] std::optional<JointCluster> run();

 private:
  using Offsets = std::vector<typename JointMesh<D>::Offset>;
  using Patch = std::vector<Index>;                          // vertices, ascending
  static constexpr int kWhole = 1 << 20, kFar = kWhole + 1;  // rings: without limit
  static constexpr std::array<int, 4> kRings{2, 6, 20, kWhole};
  static constexpr int kMostSliding = 6;  // rings of patches whose vertices slide
  static constexpr std::uint32_t kMostCalls = 3;
  static constexpr int kMostRounds = 6;  // further solutions of a patch, in each of which the elements that the last inverted weigh more
  static constexpr double kHeavier = 4.0;

  void grow(std::vector<Index> inverted);
  [[nodiscard]] std::vector<Index> inverted_elements() const;
  [[nodiscard]] std::vector<int> rings_from(const std::vector<Index>& inverted, int most) const;
  [[nodiscard]] std::vector<Patch> connected(std::span<const Index> vertices, const std::vector<int>& rings, int limit,
                                             std::size_t most) const;
  [[nodiscard]] std::vector<Patch> patches(const std::vector<Index>& inverted, int most) const;
  [[nodiscard]] std::vector<Index> elements_of(const Patch& patch) const;
  [[nodiscard]] LocalProblem<D> local_problem(const Patch& patch) const;
  [[nodiscard]] FoldoverFreeProblem<D> pose(const LocalProblem<D>& local) const;
  [[nodiscard]] double size(const std::vector<Index>& elements) const;
  void untangle(const Patch& patch);
  [[nodiscard]] Index untangle(const Patch& patch, bool springs_first);
  [[nodiscard]] std::vector<Vec3> targets_of(const LocalProblem<D>& local, const Offsets& displacements) const;
  [[nodiscard]] std::vector<Index> lost_by(const LocalProblem<D>& local, std::span<const Vec3> targets) const;
  void spare(const LocalProblem<D>& local, std::span<Vec3> targets) const;
  [[nodiscard]] bool loses_sound() const;
  void take_back();
  [[nodiscard]] bool move(const LocalProblem<D>& local, std::span<const Vec3> targets);
  void show(const LocalProblem<D>& local, const Offsets& displacements, int steps, double least);
  [[nodiscard]] JointCluster told() const;

  const JointMesh<D>& mesh_;
  Metric metric_;
  const Domain* domain_;  // null: nothing slides
  std::optional<DeviationBound> limit_;
  std::span<Vec3> positions_;
  JointState& state_;
  const JointOptions& options_;
  Progress& progress_;
  std::size_t most_together_;
  std::vector<std::pair<Index, Vec3>> moved_from_;  // old places, in the order of the moves
  std::vector<Index> vertices_;                     // vertices of the patches that rose
  double before_, after_;                           // least quality of the elements that changed
  int newton_steps_ = 0, solutions_ = 0;
  bool keeps_sound_ = false;  // whether no move may invert a sound element
  bool slides_ = false;       // whether vertices that can slide do; else they stay
  bool finished_ = false;
};

}  // namespace dmoscope
