#pragma once
// Views that the worker publishes and the window reads: immutable once published.

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

/// A state that the viewer wants to see besides the active run.
struct Watch {
  static constexpr std::uint64_t kInput = 0;
  std::uint64_t run = kInput;                // RunView::id, or the input of the active run
  std::optional<std::uint64_t> iteration{};  // iteration at whose end; none: the run's present state
  friend bool operator==(const Watch&, const Watch&) = default;
};

/// One state of one run, ready to be drawn. While a run steps on a device its frames are light: data of every vertex and every element stay
/// in `device` (positions, quality and inverted are empty), and the worst list may hold only the worst element.
struct Frame {
  static constexpr std::size_t kNoRun = static_cast<std::size_t>(-1);
  std::uint64_t serial = 0;        // grows with every frame: "did it change?"
  std::uint64_t input_serial = 0;  // grows with every opened mesh: "must the topology be uploaded again?"
  std::shared_ptr<const InputMesh> input;
  std::size_t run = 0;  // index of the run; kNoRun: the input
  Moment moment;
  Metric shown = Metric::MeanRatio;
  std::shared_ptr<const DevicePicture> device;  // data on a device; null: all of it is here
  std::string device_trouble;                   // reason why there is no `device` although the run lives on one; else empty
  std::vector<Vec3> positions;
  std::vector<float> quality;                         // quality of each element by the shown metric; NaN if it is not defined
  std::vector<std::uint8_t> inverted;                 // 1 for each element whose smallest_jacobian() is <= 0, else 0
  Statistics shown_statistics;                        // statistics by the shown metric
  Statistics statistics;                              // statistics by the metric that the run optimises
  Histogram before, now;                              // histograms by the shown metric, of the input and of this state
  std::shared_ptr<const InputSpread> input_spread{};  // spread of the input by the shown metric
  std::vector<RankedElement> worst;                   // at most 100 worst elements by the shown metric, worst first
  /// Whether the frame was published at once after the shown metric changed: `statistics`, `before` and `input_spread` are not known yet. A
  /// complete frame follows.
  bool provisional = false;
  [[nodiscard]] Index vertex_count() const noexcept { return input->mesh.vertex_count(); }
  [[nodiscard]] Index element_count() const noexcept { return static_cast<Index>(input->mesh.elements.size()); }
};

/// Figures of a run at its moment, by the shown metric: enough to draw it beside others.
struct RunSummary {
  Metric metric = Metric::MeanRatio;
  Moment moment;
  Statistics statistics;
  Histogram histogram;
  std::size_t elements = 0;   // number of elements that have a quality
  std::vector<float> sorted;  // their qualities, ascending; of many an even choice by rank, with the worst and the best
  SizeCourse sizes{};         // course of the sizes, for a run with a size function
};

/// Minimum and mean of an iteration by a metric; `own_...`: by the one that the run optimises, from its record.
struct JudgedPoint {
  std::uint64_t iteration = 0;
  double minimum = 0.0, mean = 0.0;
  double own_minimum = 0.0, own_mean = 0.0;
};

/// Figures of a run's present state, or of an input, by a metric that runs are compared by; see Judgements.
struct JudgedBy {
  Metric metric = Metric::MeanRatio;
  double minimum = 0.0, p1 = 0.0, mean = 0.0;
  std::vector<JudgedPoint> course;  // points at some iterations for a run judged by a metric of others, see judged_iterations()
};

/// Figures of the input by a metric.
struct InputSummary {
  Metric metric = Metric::MeanRatio;
  Statistics statistics;
  Percentiles percentiles;
};

/// An open mesh.
struct InputView {
  std::shared_ptr<const InputMesh> input;
  std::uint64_t serial = 0;                               // Frame::input_serial of its frames
  std::shared_ptr<const InputSummary> summary;            // summary by the shown metric; null until it is computed
  std::shared_ptr<const std::vector<JudgedBy>> judged{};  // figures by all compared metrics; null if there are none, or not yet
};

struct RunView {
  std::uint64_t id = 0;                    // identity of the run, whatever its place in the list; see Run::id
  std::shared_ptr<const InputMesh> input;  // mesh of the run
  std::string name;                        // see Run::given_name
  std::string title;                       // see Run::title
  RunParameters parameters;
  Backend backend = Backend::Cpu;  // see Run
  std::string backend_reason;
  Moment moment;
  std::optional<Pursuit> pursuit{};             // see Run
  Sweep sweep;                                  // settings of the next visits
  RunPhases phases;                             // see Run
  std::shared_ptr<const JointIteration> joint;  // result of the iteration at whose end the run stands, if that was a joint move
  std::shared_ptr<const PlaceAim> aim;          // see Run::place_aim
  std::shared_ptr<const SizeField> size;        // see Run::size_field
  std::optional<Guard> guard;                   // see Run::guard
  std::uint64_t visits_per_iteration = 0;
  std::shared_ptr<const Colouring> colouring;  // colouring of the free vertices, in the order of the visits
  Index free_vertices = 0;
  SharedVector<std::uint8_t> fixed;      // see Run::fixed
  std::shared_ptr<const Domain> domain;  // see Run::domain; valid only while the input exists
  SharedVector<IterationRecord> records;
  SharedVector<Percentiles> percentiles;                  // one for each record, by the optimised metric; empty while `percentiles` is off
  std::shared_ptr<const RunSummary> summary;              // null until it is computed, once the session is at rest
  std::size_t edits = 0, edits_done = 0;                  // number of all edits of its path, and of those up to its moment; see edit.h
  bool unsaved = false;                                   // whether ending now would lose something of it, see SavedMarks
  std::string history_note;                               // History::sentence()
  std::string last_outcome;                               // reason why it last stopped, may be empty
  std::optional<std::uint64_t> ended{};                   // iteration that it ended with before it went back to the best one, if it did
  std::uint64_t best_iteration = 0;                       // see best_iteration()
  std::shared_ptr<const RunEnding> ending{};              // see Endings
  Holds::Latest held{};                                   // hold of its minimum
  std::shared_ptr<const std::vector<JudgedBy>> judged{};  // figures by all metrics of a comparison, see InputView
  /// The cluster that holds the run's present minimum against joint moves; null: it is not known, or joint moves are impossible.
  [[nodiscard]] std::shared_ptr<const JointCluster> hold() const { return held.now && held.found ? held.found->joint : nullptr; }
  /// Whether the run is at its best iteration.
  [[nodiscard]] bool at_best() const noexcept { return moment == Moment{best_iteration}; }
};

/// Result for a Watch.
struct WatchedFrame {
  Watch what;
  std::shared_ptr<const Frame> frame;  // frame; of a run's present state the same one as long as nothing about it changes
  std::string why_not;                 // reason why there is no frame (yet); empty if there is one
};

struct SessionView {
  std::shared_ptr<const InputMesh> input;  // mesh of the active run; null: nothing is open
  std::vector<InputView> meshes;           // open meshes, in the order of their first runs
  std::vector<RunView> runs;
  std::size_t active = 0;
  Metric shown = Metric::MeanRatio;
  std::shared_ptr<const InputSummary> input_summary;  // summary of the active run's mesh, see InputView
  unsigned threads = 1;
  std::string restored_view;                      // JSON of the view that was saved with the last opened session; see save-state
  std::uint64_t restored_serial = 0;              // grows with every session opened: "must the view be restored?"
  std::shared_ptr<const ReadFiles> read_files{};  // files that must not be overwritten
  std::string undo_label, redo_label;             // commands that undo and redo are about ("run 10"); empty: there is none
  std::shared_ptr<const Frame> frame;             // frame of the active run; null if nothing is open
  std::vector<WatchedFrame> watched;              // states that Engine::watch asked for, in its order
  /// Whether runs are on different meshes, which then appear in their titles.
  [[nodiscard]] bool several_meshes() const noexcept { return meshes.size() > 1; }
};

}  // namespace dmoscope
