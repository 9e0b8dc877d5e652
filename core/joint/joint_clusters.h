#pragma once
// Joint moves: raise a mesh's minimum where no single vertex can, one cluster of vertices at a time, and say why they stop.
//
// A cluster grows around the worst element until what holds it lies inside; then the optimality conditions of the cluster are those of the
// whole mesh: to first order no joint move at all raises all its active elements.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/thread_pool.h"
#include "core/input/input_mesh.h"
#include "core/quality/power_mean.h"
#include "core/reference/domain.h"
#include "core/smooth/composite_objective.h"

namespace dmoscope {

/// Aim of joint moves: the least of a metric; or, for a combination of two, that up to the threshold, and then the least of the second
/// among the elements whose vertices have nothing at or below the threshold around them, while the first stays above it there.
struct JointObjective {
  Metric metric;
  std::optional<CompositeTerms> combination{};
  JointObjective(Metric one) : metric(one) {}  // NOLINT(google-explicit-constructor): a metric is an aim
  JointObjective(Metric first, std::optional<CompositeTerms> both) : metric(first), combination(std::move(both)) {}
};

/// Newton step, as a watcher sees it.
struct JointStep {
  int steps = 0;                      // Newton steps of this call so far
  double minimum = 0.0, bound = 0.0;  // least quality in the cluster; its greatest possible value, by duality
  std::span<const Index> vertices{};  // the cluster, ascending
  std::span<const Vec3> positions{};  // positions of these vertices in this step, which are not yet the mesh's
};

struct JointOptions {
  double gap = 2e-4;        // a cluster ends when its minimum is within this share of its bound
  bool push_first = false;  // first all free vertices together, down to `push_gap`: raises the mean as well
  double push_gap = 0.03;
  std::optional<MeanKind> mean{};   // mean of a phase that follows: a cluster that is done gives up half of the gap for it
  std::optional<Guard> guard{};     // guard that no move breaks: where all of a move would, half of it is made, and so on
  bool beyond_minimum = false;      // goes on where the minimum is certified, with the next worst elements
  int max_steps = 150;              // Newton steps of a solution
  std::size_t whole_at_most = 0;    // a cluster may become the whole mesh when this many vertices are free; 0: 80000, in volumes 3000
  std::size_t cluster_at_most = 0;  // limit for the vertices of any other cluster; 0: 80000, in volumes 1500
  std::size_t push_at_most = 0;     // the first push is left out where more are free; 0: 100000, in volumes 3000
  std::function<void(const JointStep&)> on_step{};
  ThreadPool* pool = nullptr;  // null: the calling thread alone; the same bits for any
};

/// State that later calls need of earlier ones, as a value: with the same positions and the same state a call has the same result to the
/// last bit. A new one begins anew; any other movement of vertices requires a new one.
struct JointState {
  enum class Of : std::uint8_t { Open, Tried, Closed };  // Tried: in this pass, in vain; Closed: certified to be as good as can be
  enum class End : std::uint8_t { None, Certified, NoGain };
  std::vector<Of> atoms{};       // one for each of JointClusters's atoms; empty: none was tried
  std::vector<double> levels{};  // for each vertex, the quality at which its elements are certified; +infinity: none
  std::uint32_t clusters = 0, passes = 0;
  double pass_began_at = 0.0;     // the minimum at that time
  std::uint32_t untanglings = 0;  // calls that untangle, in vain or not
  bool pushed = false;
  bool mean_raised = false;  // over the whole mesh, unless it is too large
  bool beyond = false;       // the second of two aims is raised now, and all the above belongs to it
  End end = End::None;
  friend bool operator==(const JointState&, const JointState&) = default;
};

/// Outcome of one call.
struct JointCluster {
  struct Moved {
    Index vertex;
    Vec3 to;
  };
  struct Active {
    Index element;
    double multiplier;  // share in holding the minimum; these add up to 1
  };
  /// Force by which an active element would move a vertex for its own good: its multiplier times the gradient of its quality, per mesh
  /// unit. At the end the forces on every vertex of the cluster balance.
  struct Force {
    Index element, vertex;
    Vec3 force;
  };
  std::vector<Index> vertices;       // ascending
  std::vector<Moved> moved;          // empty where nothing rose
  std::vector<Active> active;        // greatest multiplier first, ties by element; empty where there was nothing to solve
  std::vector<Force> forces;         // forces of the active elements, by element and vertex
  Index worst_element = kNoIndex;    // element that the cluster grew around; none in the first push
  double before = 0.0, after = 0.0;  // least quality of the elements that changed, or, if none did, of the worst element
  double bound = 0.0;                // greatest possible minimum of the cluster (for convex 1 / quality; else an estimate)
  double gap = 0.0;                  // (bound - minimum reached) / that minimum
  bool certified = false;            // no joint move raises all the active elements, to first order
  std::string why_not{};             // one sentence where it is not certified
  int newton_steps = 0, solutions = 0;
  bool is_push = false;
  bool beyond = false;         // whether it is about the second of two aims
  std::string aim{};           // for two aims, words after "raises": "the least min-angle and keeps mean-ratio above 0.7"
  bool is_untangling = false;  // fewer elements are inverted; it has no bound, and nothing is active
};

/// Sliding of vertices while they move jointly, and the distance at most of edges and faces from the input, in mesh units.
struct JointSliding {
  std::shared_ptr<const Domain> domain{};  // null: nothing slides
  double max_deviation = 0.0;
};

/// Reason why vertices of a mesh cannot be moved jointly: see joint_obstacle(); or the second aim is no metric. Empty where they can.
[[nodiscard]] std::string why_not_joint(const InputMesh& input, const JointObjective& aims);
/// Throws UsageError with the reason of why_not_joint(), if any.
void require_joint(const InputMesh& input, const JointObjective& aims);

/// Turns elements that are inverted, as many as it can, by moving the vertices around them together: see Untangler. Works like
/// JointClusters::raise_worst, for any metric that is defined for the mesh. Returns none where nothing helps, or on a curved surface.
[[nodiscard]] std::optional<JointCluster> untangle(const InputMesh& input, Metric metric, std::span<const std::uint8_t> fixed,
                                                   const JointSliding& sliding, std::span<Vec3> positions, const JointOptions& options,
                                                   Progress& progress);

/// Clusters of one mesh and aim. The input must outlive it. It works in memory of its own, so one thread at a time.
class JointClusters {
 public:
  /// `fixed`: one entry a vertex, non-zero where it may not move. Throws as require_joint() does.
  JointClusters(const InputMesh& input, const JointObjective& aims, std::span<const std::uint8_t> fixed, JointSliding sliding = {});
  ~JointClusters();
  JointClusters(JointClusters&&) noexcept;
  JointClusters& operator=(JointClusters&&) noexcept;

  /// Raises the worst open element with the vertices around it. `positions`: those of the whole mesh, changed only where the least quality
  /// of the elements that change rises, judged by the program's metric in double, and no more of them are inverted; the second of two aims
  /// only where the first stays above its threshold. Where elements are inverted, the first call untangles: fewer are inverted then, and
  /// the least quality is no lower. The vertices of elements left inverted stay. Returns none when state.end says why there is nothing more
  /// to do. On Cancelled positions and state are as before.
  [[nodiscard]] std::optional<JointCluster> raise_worst(std::span<Vec3> positions, JointState& state, const JointOptions& options,
                                                        Progress& progress);
  [[nodiscard]] std::size_t free_vertices() const noexcept;
  /// Returns whether a state that came from a file can belong to this mesh.
  [[nodiscard]] bool fits(const JointState& state) const noexcept;

 private:
  class Base;
  template <int D>
  class Of;
  std::unique_ptr<Base> mesh_;
};

}  // namespace dmoscope
