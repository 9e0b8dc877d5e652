#pragma once
// Where elements are inverted: one call of JointClusters::raise_worst that turns some of them the right way round.
//
// An attempt is a way to do so on patches of a size: rings of elements around the inverted ones, each connected patch a problem of its own,
// with its rim held. Attempts have an order, from what moves few vertices to the whole mesh, and a call makes one after another until a
// patch has fewer inverted elements than before and the least quality of what it changed is no lower, by the program's own judgement.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/joint/joint_clusters.h"
#include "core/joint/joint_mesh.h"

namespace dmoscope {

/// For one call. The state may be left in any state on an exception; the positions are then as they were.
template <int D>
class Untangler {
 public:
  /// `mesh`: by the mean ratio, whatever the metric is by which moves are judged.
  Untangler(const JointMesh<D>& mesh, Metric metric, std::span<Vec3> positions, JointState& state, const JointOptions& options,
            Progress& progress);
  ~Untangler();  // takes back what is not finished
  Untangler(const Untangler&) = delete;
  Untangler& operator=(const Untangler&) = delete;
  /// None: nothing is inverted that could move, or no attempt helps; the state says so, and it need not be asked again.
  [[nodiscard]] std::optional<JointCluster> run();

 private:
  using Offsets = std::vector<typename JointMesh<D>::Offset>;
  /// FoldoverFree begins where the vertices stand, Sprung where equal springs pull them; SignedPower is the interior point's.
  enum class Way : std::uint8_t { FoldoverFree, Sprung, SignedPower };
  struct Attempt {
    int rings;
    Way way;
  };
  static constexpr int kWhole = 1 << 20, kFar = kWhole + 1;  // rings: as far as it goes
  static constexpr std::array<Attempt, 9> kAttempts{{{2, Way::FoldoverFree},
                                                     {2, Way::Sprung},
                                                     {2, Way::SignedPower},
                                                     {6, Way::FoldoverFree},
                                                     {6, Way::Sprung},
                                                     {6, Way::SignedPower},
                                                     {kWhole, Way::FoldoverFree},
                                                     {kWhole, Way::Sprung},
                                                     {kWhole, Way::SignedPower}}};
  static constexpr std::uint32_t kMostAttempts = 4 * kAttempts.size();

  void attempt_all(const std::vector<Index>& inverted);
  [[nodiscard]] std::vector<Index> inverted_elements() const;
  [[nodiscard]] std::vector<int> rings_from(const std::vector<Index>& inverted, int most) const;
  [[nodiscard]] std::vector<std::vector<Index>> connected(std::span<const Index> vertices, const std::vector<int>& rings, int limit,
                                                          std::size_t most) const;
  [[nodiscard]] std::vector<std::vector<Index>> patches(const std::vector<Index>& inverted, int most) const;
  [[nodiscard]] double reference(const LocalProblem<D>& local) const;
  [[nodiscard]] bool untangle(const std::vector<Index>& patch, Way way);
  [[nodiscard]] Offsets by_interior_point(const LocalProblem<D>& local);
  [[nodiscard]] Offsets by_foldover_free(const LocalProblem<D>& local, bool sprung);
  void show(const LocalProblem<D>& local, const Offsets& displacements, int steps, double least);
  [[nodiscard]] JointCluster told() const;

  const JointMesh<D>& mesh_;
  Metric metric_;
  std::span<Vec3> positions_;
  JointState& state_;
  const JointOptions& options_;
  Progress& progress_;
  std::size_t most_together_;
  std::vector<std::uint8_t> free_;                  // of all vertices
  std::vector<std::pair<Index, Vec3>> moved_from_;  // in the order of the moves
  std::vector<Index> vertices_;                     // of the patches that rose
  double before_, after_;                           // least quality of what changed
  int newton_steps_ = 0, solutions_ = 0;
  bool finished_ = false;
};

}  // namespace dmoscope
