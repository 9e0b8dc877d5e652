#pragma once
// One call of JointClusters::raise_worst: finds the worst open atom, grows a cluster around it, solves it, and settles the outcome.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/joint/joint_clusters.h"
#include "core/joint/joint_mesh.h"
#include "core/joint/sliding_path.h"

namespace dmoscope {

/// Search of one call. An exception may leave the state in any state; the positions are then as they were.
template <int D>
class ClusterSearch {
 public:
  /// Begins a call. `threshold`: that of the first of two aims, to which `mesh` or `first` belongs; else +infinity.
  ClusterSearch(const JointMesh<D>& mesh, double threshold, const JointMesh<D>* first, const JointSliding& sliding,
                std::span<Vec3> positions, JointState& state, const JointOptions& options, Progress& progress);
  ~ClusterSearch();  // takes back unfinished moves
  ClusterSearch(const ClusterSearch&) = delete;
  ClusterSearch& operator=(const ClusterSearch&) = delete;
  [[nodiscard]] std::optional<JointCluster> run();

 private:
  static constexpr double kClosedRim = 5e-4;  // share of the multipliers on the rim below which nothing outside holds the cluster
  static constexpr double kNearTau = 0.05;    // an atom further below tau does not hold the cluster
  static constexpr double kNoticed = 0.01;    // share of the mean multiplier

  /// A solved cluster, in the mesh's terms.
  struct Solved {
    LocalProblem<D> local;
    JointSolution<D> solution;
    std::vector<Index> rim;  // vertices of atoms that hold the cluster and have vertices outside it that could move; ascending
    double rim_share = 0.0;  // share of the rim in the sum of multipliers
    std::unique_ptr<SlidingPath<D>> path{};  // null where nothing slides
  };

  void begin();
  void keep_first();
  [[nodiscard]] std::optional<Index> find_worst();
  [[nodiscard]] bool certified_minimum() const;
  [[nodiscard]] bool at_end_of_range() const;
  /// Returns whether what is raised has no other aim after it.
  [[nodiscard]] bool is_last_aim() const { return first_ != nullptr || !(threshold_ < HUGE_VAL); }
  bool next_pass();
  void allow_above(double quality);
  [[nodiscard]] std::vector<Index> grown(std::vector<Index> seeds, int rings) const;
  [[nodiscard]] std::vector<Index> all_or(std::vector<Index> cluster) const;
  [[nodiscard]] JointCluster push();
  [[nodiscard]] std::optional<JointCluster> held_at_once();
  [[nodiscard]] JointCluster raise(Index worst, int most_growths);
  void take_back();
  [[nodiscard]] Solved posed(const std::vector<Index>& cluster) const;
  void solve(const std::vector<Index>& cluster, const InteriorPointOptions& options, bool may_leave);
  void commit();
  void raise_mean(const std::vector<Index>& cluster);
  [[nodiscard]] std::vector<Vec3> targets_of(const Solved& solved, double share) const;
  [[nodiscard]] bool try_move(double share, bool& less_may_do);
  [[nodiscard]] std::vector<double> guarded(std::span<const Index> elements) const;
  [[nodiscard]] bool keeps_others(std::span<const Index> elements, std::span<const double> guarded_before) const;
  void measure_rim(const JointIterate<D>& at);
  [[nodiscard]] std::vector<Index> enlarged(const std::vector<Index>& cluster, int growth, int rings) const;
  void settle(Index worst, bool certified);
  [[nodiscard]] double reached() const;
  [[nodiscard]] JointCluster told(const std::vector<Index>& cluster) const;
  void tell_forces(JointCluster& result) const;
  [[nodiscard]] std::string aim() const;
  [[nodiscard]] const Atom<D>& atom(std::size_t local) const;
  [[nodiscard]] bool is_near(const JointIterate<D>& at, std::size_t local, double share) const;
  [[nodiscard]] std::size_t count_stopped() const;
  [[nodiscard]] std::string why_not(const std::vector<Index>& cluster) const;

  const JointMesh<D>& mesh_;
  const JointMesh<D>* first_;  // mesh by the first of two aims, where the second is raised; else null
  double threshold_;
  const Domain* domain_;  // null: nothing slides
  std::optional<DeviationBound> limit_;
  std::span<Vec3> positions_;
  JointState& state_;
  const JointOptions& options_;
  Progress& progress_;
  const AtomFunction<D>& function_;
  std::size_t whole_at_most_, cluster_at_most_, push_at_most_;
  std::vector<double> qualities_;                   // qualities of all atoms at the start
  std::vector<std::uint8_t> allowed_, inside_;      // for all vertices: may move, are in the cluster
  std::vector<std::uint8_t> frozen_;                // for all vertices: belong to an inverted element
  std::vector<std::pair<Index, Vec3>> moved_from_;  // old places, in the order of the moves
  Solved solved_;
  int newton_steps_ = 0, solutions_ = 0;
  bool holds_ = false;  // whether sliding vertices keep their places
  bool finished_ = false;
};

}  // namespace dmoscope
