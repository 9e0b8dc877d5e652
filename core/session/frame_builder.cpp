#include "core/session/frame_builder.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dmoscope {

namespace {

constexpr std::size_t kWorst = 100;

std::vector<std::uint8_t> inverted_elements(const InputMesh& input, std::span<const Vec3> positions, ThreadPool* pool) {
  std::vector<std::uint8_t> inverted(input.mesh.elements.size());
  const QualityContext context = input.quality_context();
  for_chunks(pool, inverted.size(), 8192, [&](std::size_t first, std::size_t last) {
    for (std::size_t e = first; e < last; ++e) inverted[e] = smallest_jacobian(context, positions, static_cast<Index>(e)) <= 0.0 ? 1 : 0;
  });
  return inverted;
}

RunView view_of(Run& run, bool active) {
  RunView view;
  view.title = run.title();
  view.parameters = run.parameters();
  view.moment = run.moment();
  view.visits_per_iteration = run.visits_per_iteration();
  view.class_count = run.colouring().class_count();
  view.free_vertices = static_cast<Index>(run.visits_per_iteration());
  if (active) view.fixed.assign(run.fixed().begin(), run.fixed().end());
  view.records = run.history().records();
  view.history_note = run.history().sentence();
  if (run.last_outcome()) view.last_outcome = run.last_outcome()->sentence();
  return view;
}

}  // namespace

Histogram make_histogram(std::span<const double> qualities) {
  Histogram histogram;
  const double scale = static_cast<double>(Histogram::kBins) / (histogram.highest - histogram.lowest);
  for (const double q : qualities) {
    if (std::isnan(q)) continue;
    if (q < histogram.lowest)
      ++histogram.below;
    else if (q > histogram.highest * (1.0 + 1e-12))
      ++histogram.above;
    else
      ++histogram.counts[std::min(Histogram::kBins - 1, static_cast<std::size_t>((q - histogram.lowest) * scale))];
  }
  return histogram;
}

std::vector<RankedElement> worst_elements(std::span<const double> qualities, std::size_t most) {
  const auto worse = [](const RankedElement& a, const RankedElement& b) {
    return a.quality < b.quality || (a.quality == b.quality && a.element < b.element);
  };
  std::vector<RankedElement> heap;  // the best of the worst on top
  for (std::size_t e = 0; e < qualities.size(); ++e) {
    if (std::isnan(qualities[e])) continue;
    const RankedElement ranked{static_cast<Index>(e), qualities[e]};
    if (heap.size() < most) {
      heap.push_back(ranked);
      std::ranges::push_heap(heap, worse);
    } else if (most > 0 && worse(ranked, heap.front())) {
      std::ranges::pop_heap(heap, worse);
      heap.back() = ranked;
      std::ranges::push_heap(heap, worse);
    }
  }
  std::ranges::sort_heap(heap, worse);
  return heap;
}

void FrameBuilder::refresh_input(Session& session) {
  const Metric shown = session.shown();
  const bool same_input = input_ == session.input();
  if (same_input && before_metric_ == shown && input_serial_ > 0) return;
  if (!same_input) ++input_serial_;
  input_ = session.input();
  before_metric_ = shown;
  std::vector<double> qualities(input_->mesh.elements.size());
  element_qualities(input_->quality_context(), input_->mesh.positions, shown, session.pool().get(), qualities);
  before_ = make_histogram(qualities);
}

std::shared_ptr<const Frame> FrameBuilder::frame(Session& session) {
  refresh_input(session);
  Run& run = session.active();
  const QualityContext context = input_->quality_context();
  ThreadPool* pool = session.pool().get();
  auto frame = std::make_shared<Frame>();
  frame->serial = ++serial_;
  frame->input_serial = input_serial_;
  frame->input = input_;
  frame->run = session.active_index();
  frame->moment = run.moment();
  frame->shown = session.shown();
  frame->positions.assign(run.positions().begin(), run.positions().end());
  std::vector<double> qualities(input_->mesh.elements.size());
  element_qualities(context, frame->positions, frame->shown, pool, qualities);
  frame->quality.assign(qualities.size(), 0.0F);
  std::ranges::transform(qualities, frame->quality.begin(), [](double q) { return static_cast<float>(q); });
  frame->inverted = inverted_elements(*input_, frame->positions, pool);
  frame->shown_statistics = compute_statistics(context, frame->positions, frame->shown, run.fixed(), pool);
  frame->statistics = frame->shown == run.parameters().metric ? frame->shown_statistics : run.statistics();
  frame->before = before_;
  frame->now = make_histogram(qualities);
  frame->worst = worst_elements(qualities, kWorst);
  return frame;
}

std::shared_ptr<const SessionView> FrameBuilder::build(Session& session) {
  auto view = std::make_shared<SessionView>();
  view->shown = session.shown();
  view->threads = session.pool()->size();
  if (!session.has_input()) return view;
  view->input = session.input();
  view->active = session.active_index();
  for (std::size_t i = 0; i < session.run_count(); ++i) view->runs.push_back(view_of(session.run(i), i == view->active));
  view->frame = frame(session);
  return view;
}

}  // namespace dmoscope
