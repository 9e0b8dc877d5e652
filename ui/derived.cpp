#include "ui/derived.h"

#include <algorithm>
#include <cmath>

#include "ui/view_geometry.h"

namespace dmoscope::ui {
namespace {

/// Sorting more than this many qualities would be felt; an even sample of them draws the same curve.
constexpr std::size_t kMostSorted = 65536;

void refresh_input(Derived& derived, const Frame& frame) {
  derived.metrics = usable_metrics(frame.input->mesh);
  derived.mesh_facts = frame.input->report.sentences();
  derived.kinds.fill(0);
  for (const ElementKind kind : frame.input->mesh.elements.kinds()) ++derived.kinds[static_cast<std::size_t>(kind)];
}

void refresh_range(Derived& derived, const ViewState& state, const Frame& frame) {
  derived.range = colour_range(state, &frame);
  derived.outside_low = derived.outside_high = 0;
  derived.undefined = false;
  const auto [low, high] = derived.range;
  for (std::size_t e = 0; e < frame.quality.size(); ++e) {
    const auto q = static_cast<double>(frame.quality[e]);
    if (std::isnan(q)) {
      derived.undefined = true;
    } else if (frame.inverted[e] == 0) {
      // Quality is shown in float: a hair of tolerance so that 1.0000001 is not "above 1".
      derived.outside_low += q < low - 1e-6 ? 1 : 0;
      derived.outside_high += q > high + 1e-6 ? 1 : 0;
    }
  }
}

void refresh_sorted(Derived& derived, const Frame& frame) {
  const std::size_t size = frame.quality.size(), step = std::max<std::size_t>(1, (size + kMostSorted - 1) / kMostSorted);
  const QualityContext context = frame.input->quality_context();
  derived.sorted_now.clear();
  derived.sorted_before.clear();
  for (std::size_t e = 0; e < size; e += step) {
    const double before = element_quality(context, frame.input->mesh.positions, frame.shown, static_cast<Index>(e));
    if (std::isnan(before)) continue;
    derived.sorted_now.push_back(static_cast<double>(frame.quality[e]));
    derived.sorted_before.push_back(before);
  }
  std::sort(derived.sorted_now.begin(), derived.sorted_now.end());
  std::sort(derived.sorted_before.begin(), derived.sorted_before.end());
}

}  // namespace

void refresh(Derived& derived, const ViewState& state, const SessionView& session) {
  const Frame* frame = session.frame.get();
  if (frame == nullptr) {
    derived = {};
    return;
  }
  if (derived.input_serial != frame->input_serial) {
    refresh_input(derived, *frame);
    derived.input_serial = frame->input_serial;
  }
  const bool new_frame = derived.frame_serial != frame->serial;
  derived.frame_serial = frame->serial;
  const std::tuple range_key{state.range_mode, state.range_low, state.range_high};
  if (new_frame || derived.range_key != range_key) {
    refresh_range(derived, state, *frame);
    derived.range_key = range_key;
  }
  if (new_frame) derived.sorted_now.clear();
  if (state.plot == PlotTab::Sorted && derived.sorted_now.empty()) refresh_sorted(derived, *frame);
}

}  // namespace dmoscope::ui
