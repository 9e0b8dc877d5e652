#pragma once
// What the worker publishes and the window reads: immutable once published.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/shared_vector.h"
#include "core/run/device_picture.h"
#include "core/run/percentiles.h"
#include "core/run/size_course.h"
#include "core/run/summary.h"
#include "core/session/endings.h"
#include "core/session/session.h"
#include "core/view/input_spread.h"

namespace dmoscope {

/// What whoever shows a session wants to see of it besides the active run.
struct Watch {
  static constexpr std::uint64_t kInput = 0;
  std::uint64_t run = kInput;                // RunView::id, or the input of the active run
  std::optional<std::uint64_t> iteration{};  // at the end of which; none: as the run stands
  friend bool operator==(const Watch&, const Watch&) = default;
};

/// One state of one run, ready to be drawn. While a run steps on a device its frames are light: what there is of every vertex and every
/// element stays in `device` (positions, quality and inverted are empty), and the worst list may hold the worst element alone.
struct Frame {
  static constexpr std::size_t kNoRun = static_cast<std::size_t>(-1);
  std::uint64_t serial = 0;        // grows with every frame: "did it change?"
  std::uint64_t input_serial = 0;  // grows with every opened mesh: "must the topology be uploaded again?"
  std::shared_ptr<const InputMesh> input;
  std::size_t run = 0;  // kNoRun: the input as such
  Moment moment;
  Metric shown = Metric::MeanRatio;
  std::shared_ptr<const DevicePicture> device;  // null: all of it is here
  std::string device_trouble;                   // why there is none although the run lives on a device; empty when there is no such reason
  std::vector<Vec3> positions;
  std::vector<float> quality;                         // of the shown metric, one an element; NaN where it is not defined
  std::vector<std::uint8_t> inverted;                 // one an element, 1 where smallest_jacobian() is <= 0
  Statistics shown_statistics;                        // of the shown metric
  Statistics statistics;                              // of the metric the run optimises
  Histogram before, now;                              // of the shown metric: at the input, and here
  std::shared_ptr<const InputSpread> input_spread{};  // of the shown metric
  std::vector<RankedElement> worst;                   // of the shown metric, worst first, at most 100
  /// Published at once after another metric was asked for: `statistics`, `before` and `input_spread` are not known yet. One that has them
  /// follows.
  bool provisional = false;
  [[nodiscard]] Index vertex_count() const noexcept { return input->mesh.vertex_count(); }
  [[nodiscard]] Index element_count() const noexcept { return static_cast<Index>(input->mesh.elements.size()); }
};

/// How a run fares at its moment, by the metric that is shown: enough to draw it beside others.
struct RunSummary {
  Metric metric = Metric::MeanRatio;
  Moment moment;
  Statistics statistics;
  Histogram histogram;
  std::size_t elements = 0;   // that have a quality
  std::vector<float> sorted;  // their qualities, ascending; of many an even choice by rank, the worst and the best among them
  SizeCourse sizes{};         // of a run with a size function
};

/// What an iteration comes to by a metric; `own_...`: by the one that the run optimises, as its record has it.
struct JudgedPoint {
  std::uint64_t iteration = 0;
  double minimum = 0.0, mean = 0.0;
  double own_minimum = 0.0, own_mean = 0.0;
};

/// How a run as it stands, or an input, fares by a metric that runs are compared by; see Judgements.
struct JudgedBy {
  Metric metric = Metric::MeanRatio;
  double minimum = 0.0, p1 = 0.0, mean = 0.0;
  std::vector<JudgedPoint> course;  // of a run by a metric of others; at some of its iterations, see judged_iterations()
};

/// How the input fares by a metric.
struct InputSummary {
  Metric metric = Metric::MeanRatio;
  Statistics statistics;
  Percentiles percentiles;
};

/// A mesh that is open.
struct InputView {
  std::shared_ptr<const InputMesh> input;
  std::uint64_t serial = 0;                     // Frame::input_serial of its frames
  std::shared_ptr<const InputSummary> summary;  // by the metric that is shown; null until it has been worked out, as those of runs
  std::shared_ptr<const std::vector<JudgedBy>> judged{};  // by all metrics of a comparison; null where there is none, or not yet
};

struct RunView {
  std::uint64_t id = 0;                    // which run it is, whatever its place in the list; see Run::id
  std::shared_ptr<const InputMesh> input;  // its mesh
  std::string name;                        // see Run::given_name
  std::string title;                       // see Run::title
  RunParameters parameters;
  Backend backend = Backend::Cpu;  // see Run
  std::string backend_reason;
  Moment moment;
  std::optional<Pursuit> pursuit{};             // see Run
  Sweep sweep;                                  // what the next visits are part of
  RunPhases phases;                             // see Run
  std::shared_ptr<const JointIteration> joint;  // what the iteration at whose end the run stands did, where that was a joint move
  std::shared_ptr<const SizeField> size;        // see Run::size_field
  std::optional<Guard> guard;                   // see Run::guard
  std::uint64_t visits_per_iteration = 0;
  std::shared_ptr<const Colouring> colouring;  // of the free vertices, in the order of the visits
  Index free_vertices = 0;
  SharedVector<std::uint8_t> fixed;      // see Run::fixed
  std::shared_ptr<const Domain> domain;  // see Run::domain; the input must be at hand
  SharedVector<IterationRecord> records;
  SharedVector<Percentiles> percentiles;                  // of the metric it optimises, one a record; empty while `percentiles` is off
  std::shared_ptr<const RunSummary> summary;              // null until it has been worked out, which is once the session is at rest
  std::size_t edits = 0, edits_done = 0;                  // all of its path, and those up to its moment; see edit.h
  bool unsaved = false;                                   // ending now would lose something of it, see SavedMarks
  std::string history_note;                               // History::sentence()
  std::string last_outcome;                               // why it last stopped, may be empty
  std::optional<std::uint64_t> ended{};                   // the iteration that it ended with before it went back to the best, where it did
  std::uint64_t best_iteration = 0;                       // see best_iteration()
  std::shared_ptr<const RunEnding> ending{};              // see Endings
  Holds::Latest held{};                                   // what holds its minimum
  std::shared_ptr<const std::vector<JudgedBy>> judged{};  // as InputView's
  /// What holds the minimum as the run stands, by joint moves; null: it is not known, or they cannot be.
  [[nodiscard]] std::shared_ptr<const JointCluster> hold() const { return held.now && held.found ? held.found->joint : nullptr; }
  /// Whether there is no better iteration to go to.
  [[nodiscard]] bool at_best() const noexcept { return moment == Moment{best_iteration}; }
};

/// What there is of a Watch.
struct WatchedFrame {
  Watch what;
  std::shared_ptr<const Frame> frame;  // of a run as it stands the same one as long as nothing about it changes
  std::string why_not;                 // there is no frame (yet); empty when there is one
};

struct SessionView {
  std::shared_ptr<const InputMesh> input;  // of the active run; null: nothing is open
  std::vector<InputView> meshes;           // that are open, in the order of their first runs
  std::vector<RunView> runs;
  std::size_t active = 0;
  Metric shown = Metric::MeanRatio;
  std::shared_ptr<const InputSummary> input_summary;  // of the active run's mesh, see InputView
  unsigned threads = 1;
  std::string restored_view;                      // the JSON that was saved with the session that was opened last; see save-state
  std::uint64_t restored_serial = 0;              // grows with every session opened: "must the view be restored?"
  std::shared_ptr<const ReadFiles> read_files{};  // which nothing that is written may replace
  std::string undo_label, redo_label;             // the commands that undo and redo are about ("run 10"); empty: there is none
  std::shared_ptr<const Frame> frame;             // of the active run; null when nothing is open
  std::vector<WatchedFrame> watched;              // what Engine::watch asked for, in its order
  /// Whether runs are on different meshes, so that they are told apart by those, too.
  [[nodiscard]] bool several_meshes() const noexcept { return meshes.size() > 1; }
};

}  // namespace dmoscope
