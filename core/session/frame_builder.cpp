#include "core/session/frame_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/quality/tally.h"

namespace dmoscope {

namespace {

constexpr std::size_t kWorst = 100;

constexpr std::size_t kGrain = std::size_t{1} << 15U;

/// A histogram that is being filled.
class Bins {
 public:
  void add(double q) { ++counts_[histogram_slot(q)]; }
  void add(const Bins& other) {
    for (std::size_t slot = 0; slot < counts_.size(); ++slot) counts_[slot] += other.counts_[slot];
  }
  [[nodiscard]] Histogram histogram() const {
    Histogram histogram;
    std::copy_n(counts_.begin(), Histogram::kBins, histogram.counts.begin());
    histogram.below = counts_[kSlotBelow];
    histogram.above = counts_[kSlotAbove];
    return histogram;
  }

 private:
  std::array<Index, kSlotNowhere + 1> counts_{};
};

bool worse(const RankedElement& a, const RankedElement& b) {
  return a.quality < b.quality || (a.quality == b.quality && a.element < b.element);
}

/// The worst of the elements offered.
class Worst {
 public:
  explicit Worst(std::size_t most) : most_(most) {}
  void offer(const RankedElement& ranked) {
    if (heap_.size() == most_) {
      if (most_ == 0 || !worse(ranked, heap_.front())) return;
      std::ranges::pop_heap(heap_, worse);
      heap_.back() = ranked;
    } else {
      if (std::isnan(ranked.quality)) return;
      heap_.push_back(ranked);
    }
    std::ranges::push_heap(heap_, worse);
  }
  void offer_all_of(const Worst& other) {
    for (const RankedElement& ranked : other.heap_) offer(ranked);
  }
  /// Worst first.
  [[nodiscard]] std::vector<RankedElement> take() {
    std::ranges::sort_heap(heap_, worse);
    return std::move(heap_);
  }

 private:
  std::size_t most_;
  std::vector<RankedElement> heap_;  // the best of the worst on top
};

/// What a stretch of the elements shows.
struct Part {
  Tally tally;
  Bins bins;
  Worst worst{kWorst};
};

/// Takes what a device knows of the run as it stands, if it lives on one. False: it must come from the host.
bool take_picture(Frame& frame, const Run& run) {
  try {
    frame.device = run.picture(frame.shown);
  } catch (const DeviceError& error) {
    frame.device_trouble = error.what();
  }
  if (!frame.device) return false;
  const ElementSummary& summary = frame.device->summary();
  frame.shown_statistics = summary.statistics;
  frame.now = summary.histogram;
  frame.worst = summary.worst;
  return true;
}

/// All that a frame shows of the elements, in one pass over them.
void judge_elements(Frame& frame, std::span<const Index> immovable, ThreadPool* pool) {
  const std::size_t count = frame.input->mesh.elements.size();
  frame.quality = large_vector<float>(count);
  frame.inverted = large_vector<std::uint8_t>(count);
  std::vector<Part> parts((count + kGrain - 1) / kGrain);
  for_chunks(pool, count, kGrain, [&](std::size_t first, std::size_t last) {
    Part part;
    for_blocks(frame.input->quality_context(), frame.positions, frame.shown, first, last, [&](const ElementBlock& block) {
      part.tally.add(block, immovable);
      for (std::size_t i = 0; i < block.count; ++i) {
        const double q = block.quality[i];
        frame.quality[block.first + i] = static_cast<float>(q);
        frame.inverted[block.first + i] = block.jacobian[i] <= 0.0 ? 1 : 0;
        part.bins.add(q);
        part.worst.offer({block.first + static_cast<Index>(i), q, block.jacobian[i] <= 0.0});
      }
    });
    parts[first / kGrain] = std::move(part);
  });
  Part whole;
  for (const Part& part : parts) {
    whole.tally.append(part.tally);
    whole.bins.add(part.bins);
    whole.worst.offer_all_of(part.worst);
  }
  frame.shown_statistics = whole.tally.statistics();
  frame.now = whole.bins.histogram();
  frame.worst = whole.worst.take();
}

Histogram histogram_of(const InputMesh& input, Metric metric, ThreadPool* pool) {
  const std::size_t count = input.mesh.elements.size();
  std::vector<Bins> parts((count + kGrain - 1) / kGrain);
  for_chunks(pool, count, kGrain, [&](std::size_t first, std::size_t last) {
    Bins bins;
    for_blocks(input.quality_context(), input.mesh.positions, metric, first, last, [&](const ElementBlock& block) {
      for (const double q : block.qualities()) bins.add(q);
    });
    parts[first / kGrain] = bins;
  });
  Bins whole;
  for (const Bins& part : parts) whole.add(part);
  return whole.histogram();
}

RunView view_of(Run& run, bool percentiles) {
  RunView view;
  view.title = run.title();
  view.parameters = run.parameters();
  view.backend = run.backend();
  view.backend_reason = run.backend_reason();
  view.moment = run.moment();
  view.visits_per_iteration = run.visits_per_iteration();
  view.colouring = run.shared_colouring();
  view.free_vertices = static_cast<Index>(run.visits_per_iteration());
  view.fixed = run.shared_fixed();
  view.records = run.history().shared_records();
  if (percentiles) view.percentiles = run.history().shared_percentiles();
  view.edits = run.edits().all().size();
  view.edits_done = run.edits().done_by(run.moment());
  view.history_note = run.history().sentence();
  if (run.last_outcome()) view.last_outcome = run.last_outcome()->sentence();
  return view;
}

}  // namespace

Frame judged(Session& session, std::size_t index) {
  const Run& run = session.run(index);
  Frame frame;
  frame.input = session.input();
  frame.moment = run.moment();
  frame.shown = session.shown();
  frame.positions.assign(run.positions().begin(), run.positions().end());
  judge_elements(frame, run.immovable(), session.pool().get());
  return frame;
}

Histogram make_histogram(std::span<const double> qualities) {
  Bins bins;
  for (const double q : qualities) bins.add(q);
  return bins.histogram();
}

std::vector<RankedElement> worst_elements(std::span<const double> qualities, std::size_t most) {
  Worst worst(most);
  for (std::size_t e = 0; e < qualities.size(); ++e) worst.offer({.element = static_cast<Index>(e), .quality = qualities[e]});
  return worst.take();
}

void FrameBuilder::refresh_input(Session& session) {
  const Metric shown = session.shown();
  const bool same_input = input_ == session.input();
  if (same_input && before_metric_ == shown && input_serial_ > 0) return;
  if (!same_input) ++input_serial_;
  input_ = session.input();
  before_metric_ = shown;
  before_ = histogram_of(*input_, shown, session.pool().get());
}

bool FrameBuilder::FrameKey::is(const FrameKey& other) const {
  return !run.expired() && run.lock() == other.run.lock() && index == other.index && path == other.path && moment == other.moment &&
         shown == other.shown;
}

FrameBuilder::FrameKey FrameBuilder::key_of(Session& session) {
  const Run& run = session.active();
  return {session.identity(session.active_index()), session.active_index(), run.path(), run.moment(), session.shown()};
}

bool FrameBuilder::work_at_rest(Session& session, const std::function<bool()>& go_on) {
  if (!session.has_input() || !last_ || !last_key_.is(key_of(session))) return false;
  bool found = summaries_.find(session, *last_, go_on);
  for (std::size_t i = 0; session.percentiles() && i < session.run_count(); ++i)
    if (session.run(i).find_percentiles([&](double) { return go_on(); })) found = true;
  return found;
}

std::shared_ptr<const Frame> FrameBuilder::frame(Session& session, FrameDetail detail) {
  const FrameKey key = key_of(session);
  if (last_ && last_->input == session.input() && key.is(last_key_)) return last_;
  refresh_input(session);
  Run& run = session.active();
  auto frame = std::make_shared<Frame>();
  frame->serial = ++serial_;
  frame->input_serial = input_serial_;
  frame->input = input_;
  frame->run = session.active_index();
  frame->moment = run.moment();
  frame->shown = session.shown();
  if (detail == FrameDetail::Whole || !take_picture(*frame, run)) {
    const auto positions = run.positions();
    reserve_large(frame->positions, positions.size());
    frame->positions.assign(positions.begin(), positions.end());
    judge_elements(*frame, run.immovable(), session.pool().get());
  }
  frame->statistics = frame->shown == run.parameters().metric ? frame->shown_statistics : run.statistics();
  frame->before = before_;
  if (!frame->device) {
    last_ = frame;
    last_key_ = key;
  }
  return frame;
}

std::shared_ptr<const SessionView> FrameBuilder::build(Session& session, FrameDetail detail) {
  auto view = std::make_shared<SessionView>();
  view->shown = session.shown();
  view->threads = session.pool()->size();
  if (!session.has_input()) return view;
  if (const UndoEntry* entry = session.undo_stack().to_undo()) view->undo_label = entry->label;
  if (const UndoEntry* entry = session.undo_stack().to_redo()) view->redo_label = entry->label;
  view->restored_view = session.restored_view();
  view->restored_serial = session.restored_views();
  view->input = session.input();
  view->active = session.active_index();
  for (std::size_t i = 0; i < session.run_count(); ++i) {
    view->runs.push_back(view_of(session.run(i), session.percentiles()));
    view->runs.back().summary = summaries_.of(session, i);
  }
  view->frame = frame(session, detail);
  return view;
}

}  // namespace dmoscope
