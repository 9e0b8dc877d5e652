#pragma once
// A run: one method, metric and set of parameters on the input mesh, with its own positions and history.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/base/shared_vector.h"
#include "core/base/thread_pool.h"
#include "core/input/input_mesh.h"
#include "core/mesh/colouring.h"
#include "core/quality/quality.h"
#include "core/run/best_state.h"
#include "core/run/block_plan.h"
#include "core/run/edit.h"
#include "core/run/history.h"
#include "core/run/joint_course.h"
#include "core/run/parameters.h"
#include "core/run/phase_start.h"
#include "core/run/phases.h"
#include "core/run/position_buffer.h"
#include "core/search/parameters.h"
#include "core/smooth/execution/executor.h"
#include "core/smooth/size_field.h"

namespace dmoscope {

struct MeshRegion;

enum class StepUnit { Vertex, Class, Iteration };

/// Goal of the iterations under way: those of Run::iterate and Run::until_converged, while they are at work.
struct Pursuit {
  std::uint64_t from = 0, last = 0;  // the iteration at whose end it began, and that with which it ends at the latest
  bool until_converged = false;
  /// Number of further iterations without a gain after which until_converged ends; none while patience does not end it.
  std::optional<std::uint64_t> patience_left{};
};

/// Limits at which "until converged" stops.
struct ConvergenceLimits {
  std::uint64_t patience = 200;  // iterations without a rise of either minimum by `rise`
  std::uint64_t max_iterations = 10000;
  double rise = kLeastRise;
};
/// An iteration in which vertices around inverted elements moved together, and how many of these it found and left.
struct JointUntangling {
  std::uint64_t iteration = 0, moved = 0;
  Index before = 0, after = 0;
};
enum class StopReason { NothingMoved, NoRise, Certified, NoJointGain, IterationLimit };
struct Outcome {
  StopReason reason = StopReason::IterationLimit;
  std::uint64_t iterations = 0;         // done by this call
  std::uint64_t ended = 0;              // the iteration that it ended with
  std::uint64_t last_rise = 0;          // iteration in which a minimum last rose by limits.rise; 0: never
  RunPhases phases{};                   // the phases that were reached
  Index inverted = 0;                   // inverted elements at the end
  std::optional<std::uint64_t> best{};  // the iteration that end_at_best() went back to
  ConvergenceLimits limits;
  bool two_aims = false;     // whether the run had a combination
  std::uint64_t raised = 0;  // iterations in which vertices around the worst element moved together, within the method's phase
  std::vector<JointUntangling> untanglings{};  // iterations that untangled any elements
  /// Sentence on the end: "converged: no vertex moved any more; the minimum last rose in iteration 9".
  [[nodiscard]] std::string sentence() const;
};

/// Moment at which a run stands, and its path.
struct RunSnapshot {
  Moment moment{};
  SharedVector<Edit> edits{};
  SharedVector<IterationRecord> records{};
  std::optional<Outcome> outcome{};
  std::uint64_t path = 0;  // Run::path()
  JointPath joint{};
};

/// Joint move of the vertices around the worst element, found at the end of an iteration for the next one.
struct RaiseOfWorst {
  std::uint64_t iteration = 0;
  bool certified = false;                  // no joint move raises it by a worthwhile amount
  std::vector<JointCluster::Moved> moved;  // vertices of this process; empty: not known, or it gains too little
  std::uint64_t count = 0;                 // number of vertices in all processes
  JointFigures figures{};
  double seconds = 0.0;
};

/// Positions that a run begins with if it continues another one; null: those of the input.
using BeginPositions = std::shared_ptr<const std::vector<Vec3>>;

class Run {
 public:
  /// Throws UsageError for parameters out of range, an unknown method, a metric not defined for the mesh, or a backend that cannot do it;
  /// DeviceError when the backend asked for by name fails. `begin`: positions of the vertices in iteration 0; null: those of the input, to
  /// which reference, fixed vertices and guard belong in any case. Throws UsageError where a fixed vertex begins elsewhere than in the
  /// input.
  Run(std::shared_ptr<const InputMesh> input, RunParameters parameters, std::shared_ptr<ThreadPool> pool, std::size_t history_bytes,
      Acceleration acceleration = {}, BeginPositions begin = nullptr);
  ~Run();
  Run(Run&&) noexcept;
  Run& operator=(Run&&) noexcept;

  /// Number of the run within its session, which gives it: it stays when the parameters of an untouched run change or its mesh is read
  /// again. 0: not part of a session.
  [[nodiscard]] std::uint64_t id() const noexcept { return id_; }
  void set_id(std::uint64_t id) noexcept { id_ = id; }
  /// Name that a person gave the run, set by the session; empty: none.
  [[nodiscard]] const std::string& given_name() const noexcept { return given_name_; }
  void set_given_name(std::string name) noexcept { given_name_ = std::move(name); }
  [[nodiscard]] const InputMesh& input() const noexcept { return *input_; }
  [[nodiscard]] const std::shared_ptr<const InputMesh>& shared_input() const noexcept { return input_; }
  [[nodiscard]] const RunParameters& parameters() const noexcept { return parameters_; }
  [[nodiscard]] const BeginPositions& begin() const noexcept { return begin_; }
  /// Name of the run; if it has none, its method and parameters: "dmo · mean ratio, grid 12".
  [[nodiscard]] std::string title() const;
  [[nodiscard]] RunPhases phases() const;
  /// Begin of a later phase, see RunPhases; looks at no more records than it must.
  [[nodiscard]] std::optional<std::uint64_t> joint_since() const;
  [[nodiscard]] std::optional<std::uint64_t> mean_since() const;
  /// Joint move that an iteration made; null where it is not at hand.
  [[nodiscard]] std::shared_ptr<const JointIteration> joint_iteration(std::uint64_t iteration) const {
    return joint_course_.find(iteration);
  }
  /// State of the joint moves at the end of the iteration in which the run stands; null outside their phase.
  [[nodiscard]] std::shared_ptr<const JointStanding> joint_standing() const;
  /// Sweep that the next visits are part of.
  [[nodiscard]] Sweep sweep() const;
  /// Size function of a combination; null where there is none.
  [[nodiscard]] std::shared_ptr<const SizeField> size_field() const;
  /// Second aim of a combination that is no metric; null where there is none.
  [[nodiscard]] const std::shared_ptr<const PlaceAim>& place_aim() const noexcept { return aim_; }
  /// Guard in force: none where it is off, or says nothing beyond the metrics that are raised.
  [[nodiscard]] const std::optional<Guard>& guard() const noexcept { return guard_; }
  /// Backend in use, whatever was asked for: never Backend::Auto.
  [[nodiscard]] Backend backend() const noexcept { return executor_.backend; }
  /// Name of the device; on the CPU, the reason for not using cuda, empty where it was not wanted.
  [[nodiscard]] const std::string& backend_reason() const noexcept { return executor_.reason; }
  /// Backend with its reason: "cuda: NVIDIA H200, ...", "cpu, 8 threads (no cuda: built without a CUDA toolkit)".
  [[nodiscard]] std::string backend_sentence() const;
  /// Warning about the backend that has arisen since the last call; usually empty.
  [[nodiscard]] std::string take_warning() { return std::exchange(executor_.warning, {}); }

  /// Positions at this moment; brings them up to date first, so only on the thread that steps. A later step makes the span out of date.
  /// Throws DeviceError; see recover().
  [[nodiscard]] std::span<const Vec3> positions() const;
  [[nodiscard]] const Moment& moment() const noexcept { return at_.moment; }
  /// Statistics of the optimised metric at this moment. Throws DeviceError; see recover().
  [[nodiscard]] Statistics statistics() const;
  /// Picture of positions that live on a device, see Smoother::picture; null where they do not. Throws DeviceError, which need not mean
  /// that the device is lost.
  [[nodiscard]] std::shared_ptr<const DevicePicture> picture(Metric shown) const;
  /// Brings the positions to the host and keeps them in the history, so that no failure of a device can lose them.
  void sync_to_host();
  /// Recovers from a DeviceError of one of the above: goes back to the last moment whose positions the host has, and on from there on the
  /// CPU. Functions that change the run do so by themselves before they throw the DeviceError. Without a failure: does nothing.
  void recover();
  [[nodiscard]] const Colouring& colouring() const noexcept { return *colouring_; }
  [[nodiscard]] const std::shared_ptr<const Colouring>& shared_colouring() const noexcept { return colouring_; }
  /// 1 where a vertex may not move: boundary, unused, on an interface that is fixed, or the user's.
  [[nodiscard]] std::span<const std::uint8_t> fixed() const noexcept { return fixed_; }
  /// Curves and facets that vertices slide on; null: no vertex slides.
  [[nodiscard]] const std::shared_ptr<const Domain>& domain() const noexcept { return domain_; }
  [[nodiscard]] const SharedVector<std::uint8_t>& shared_fixed() const noexcept { return fixed_; }
  /// Reason why a vertex is fixed, "it lies on the boundary, which stays"; empty for a free vertex.
  [[nodiscard]] std::string why_fixed(Index vertex) const;
  /// Immovable elements, whose corners are all fixed, ascending: see compute_statistics.
  [[nodiscard]] std::span<const Index> immovable() const noexcept { return immovable_; }
  [[nodiscard]] std::uint64_t visits_per_iteration() const noexcept { return colouring_->order.size(); }
  [[nodiscard]] const History& history() const noexcept { return history_; }
  void set_history_budget(std::size_t bytes) { history_.set_budget(bytes); }
  void set_pool(std::shared_ptr<ThreadPool> pool) { pool_ = std::move(pool); }

  /// Goes forwards by one vertex, or by one colour class or iteration (the rest of it when in its midst). Edits on the way are done again;
  /// one is a step like a vertex. In a phase of joint moves each is a whole iteration, which is one cluster. Returns vertices moved, not
  /// counting those that edits moved. On Cancelled the run stands at an exact moment between two visits; nothing is lost. On DeviceError
  /// (here and in all below) the run has recovered: see recover().
  std::uint64_t step(StepUnit unit, Progress& progress);
  /// Goes backwards: to the previous vertex, class start or iteration start. At the input does nothing and returns false.
  bool back(StepUnit unit, Progress& progress);
  /// Goes to any moment, past or future: restores the nearest kept positions before it and repeats the visits from there (the same bits).
  /// Throws UsageError for more visits or edits than there are.
  void seek(const Moment& wanted, Progress& progress);

  /// Visits these free vertices now, out of their turn, each once, in the order in which an iteration visits them; returns how many moved.
  /// That is an edit (or several, where they are many): it belongs to the run's path from now on, and what came after this moment so far
  /// is forgotten. Throws UsageError, with nothing done, for a vertex that is fixed or does not exist. On Cancelled nothing is done.
  std::uint64_t visit_vertices(std::span<const Index> vertices, Progress& progress);
  [[nodiscard]] const Edits& edits() const noexcept { return edits_; }
  /// Goes back to the begin, the input or BeginPositions, and forgets the edits.
  void reset(Progress& progress);
  [[nodiscard]] RunSnapshot point() const;
  /// Goes to the moment of a snapshot of this run, even if its path has changed since then. On Cancelled the run stands at an exact moment
  /// of that path.
  void go_to(const RunSnapshot& point, Progress& progress);
  /// Frees what only smoothing needs, some of it on a device; the next smoothing makes it again.
  void rest();

  /// Works out the percentiles (of the optimised metric) of those recorded iterations that lack them and whose positions are known, asking
  /// `go_on`, which gets the share that is done, before each. Returns whether there are new ones.
  bool find_percentiles(const std::function<bool(double)>& go_on);

  /// Takes over the known part of a path from elsewhere, with the positions at the end of iteration point.moment.iteration, and goes to its
  /// moment. Only for a fresh run. Throws UsageError for edits or moments that this run cannot have.
  void adopt(const RunSnapshot& point, std::span<const Vec3> positions, Progress& progress);

  /// Number that changes whenever a moment may show other positions than it did before: same run, same path, same moment, same bits.
  [[nodiscard]] std::uint64_t path() const noexcept { return path_; }

  /// Sets a function that is called between two blocks of visits, on the thread that steps, at least every 100 ms or so, to publish
  /// progress.
  void set_observer(std::function<void(const Run&)> observer) { observer_ = std::move(observer); }

  /// Function that the two calls below call after every iteration, on the calling thread.
  using AfterIteration = std::function<void(const Run&)>;
  Outcome iterate(std::uint64_t iterations, Progress& progress, const AfterIteration& after = {});
  /// Go on with a call that was made at the input, from the end of an iteration where the run stands: they end when and as that call would
  /// have. For a run that was saved on its way (see adopt). `after` is not called again for iterations before it.
  Outcome iterate_from_input(std::uint64_t iterations, Progress& progress, const AfterIteration& after = {});
  Outcome until_converged_from_input(const ConvergenceLimits& limits, Progress& progress, const AfterIteration& after = {});
  /// Reason why the last of these two calls stopped; none after any other step.
  [[nodiscard]] const std::optional<Outcome>& last_outcome() const noexcept { return last_outcome_; }
  Outcome until_converged(const ConvergenceLimits& limits, Progress& progress, const AfterIteration& after = {});
  /// Goes back to the best iteration (see BestState) after one of these calls, where that is not the last; last_outcome() says so.
  void end_at_best(Progress& progress);
  /// Goal of the call of these four that is under way; none while none is.
  [[nodiscard]] const std::optional<Pursuit>& pursuit() const noexcept { return pursuit_; }

 private:
  class Advance;  // see run_advance.cpp
  [[nodiscard]] SmoothingTask task() const;
  [[nodiscard]] BlockPlan block_plan() const;
  void ensure_smoother();
  void download() const;
  void keep();
  void walk_to(const Moment& target, Progress& progress);
  [[nodiscard]] Moment moment_before(StepUnit unit) const;
  void restore(std::uint64_t iteration);
  void forget_after(std::uint64_t iteration);
  std::uint64_t ask_smoother(std::uint64_t first, std::uint64_t count);
  void put(std::span<const Vec3> positions, const RunProgress& place);
  void visit(std::uint64_t count, Progress& progress);
  [[nodiscard]] std::vector<Index> ranks_of(std::span<const Index> vertices);
  std::uint64_t do_edit(std::span<const Index> vertices);
  void visit_block(std::uint64_t count);
  void end_iteration();
  void record(const RunProgress& done);
  void begin_next_phase(Progress& progress);
  [[nodiscard]] std::optional<std::uint64_t> first_phase_end() const;
  [[nodiscard]] std::optional<std::uint64_t> first_phase_best() const;
  [[nodiscard]] std::optional<std::uint64_t> joint_over() const;
  [[nodiscard]] bool joint_follows(std::uint64_t iteration) const;
  [[nodiscard]] bool joint_untangling_follows(std::uint64_t iteration) const;
  [[nodiscard]] bool raise_of_worst_follows(std::uint64_t iteration) const;
  [[nodiscard]] bool is_joint(std::uint64_t iteration) const;
  [[nodiscard]] std::optional<MeshRegion> region_of_inverted(std::span<const Vec3> positions) const;
  [[nodiscard]] std::optional<Guard> joint_guard() const;
  [[nodiscard]] JointObjective joint_aims() const;
  [[nodiscard]] JointClusters& joint_clusters();
  void move_jointly(Progress& progress);
  void untangle_jointly(Progress& progress);
  /// Whether the next iteration draws vertices to the surface of another mesh.
  [[nodiscard]] bool fit_follows(std::uint64_t iteration) const { return parameters_.fit > 0.0 && iteration == 0; }
  void fit(Progress& progress);
  void end_joint_iteration(std::span<const Vec3> positions, const JointIteration& done, double seconds);
  [[nodiscard]] bool copy_unkept(std::vector<Vec3>& copy) const;
  [[nodiscard]] bool attempts_to_untangle(std::uint64_t iteration) const;
  [[nodiscard]] bool can_be_certified() const;
  [[nodiscard]] bool can_raise_worst() const;
  bool raise_follows_look(RaiseOfWorst look);
  [[nodiscard]] std::optional<double> second_minimum() const;
  [[nodiscard]] RaiseOfWorst look_at_worst(Progress& progress);
  void raise_worst_jointly(Progress& progress);
  [[nodiscard]] bool knows_joint_moves() const;
  template <class Body>
  auto asking_device(const Body& body) const;
  template <class Body>
  auto recovering(const Body& body);

  std::uint64_t id_ = 0;
  std::string given_name_;
  std::shared_ptr<const InputMesh> input_;
  RunParameters parameters_;
  BeginPositions begin_;
  std::shared_ptr<ThreadPool> pool_;
  Acceleration acceleration_;
  std::shared_ptr<const Domain> domain_;  // curves and facets that vertices slide on; null: no vertex slides
  SharedVector<std::uint8_t> fixed_;
  std::shared_ptr<const Colouring> colouring_;
  std::vector<Index> immovable_;
  std::shared_ptr<const PlaceAim> aim_;
  std::optional<Guard> guard_;
  Executor executor_;  // its smoother is null while the run rests
  RunProgress at_;
  mutable PositionBuffer positions_;  // brought up to date by positions()
  mutable std::string failure_;       // failure of the device, until recover()
  double unkept_seconds_ = 0.0;       // duration of smoothing since positions were last kept
  std::uint64_t last_moved_ = 0;      // vertices moved in the iteration last ended
  BlockPlan blocks_;
  History history_;
  mutable PhaseSwitchDetector turn_;
  BestPositions first_phase_;
  JointCourse joint_course_;
  std::unique_ptr<JointClusters> joint_clusters_;  // null while not needed
  std::optional<Sweep> begun_;                     // sweep that the smoother was told last
  Edits edits_;
  std::uint64_t path_ = 0;
  std::vector<Index> rank_of_;  // rank of every vertex in the colouring's order; empty until there is an edit
  std::function<void(const Run&)> observer_;
  std::optional<Outcome> last_outcome_;
  std::optional<Pursuit> pursuit_;
  // State of a run until convergence: joint raises of a stuck worst element are allowed; one was looked for since the minimum last rose.
  bool raises_ = false, looked_ = false;
  std::optional<RaiseOfWorst> next_raise_;  // joint move for the next iteration; none: it is as its kind says
};

/// Calls a body that may ask a device; a failure is remembered for recover().
template <class Body>
auto Run::asking_device(const Body& body) const {
  try {
    return body();
  } catch (const DeviceError& error) {
    failure_ = error.what();
    throw;
  }
}

/// Calls a body that may ask a device; after a failure recovers the run before it throws.
template <class Body>
auto Run::recovering(const Body& body) {
  try {
    return body();
  } catch (const DeviceError&) {
    recover();
    throw DeviceError(take_warning());
  }
}

}  // namespace dmoscope
