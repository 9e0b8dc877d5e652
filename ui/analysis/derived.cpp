#include "ui/analysis/derived.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include <fmt/format.h>

#include "core/mesh/group_facts.h"
#include "core/mesh/seam.h"
#include "ui/analysis/counting_elements.h"
#include "ui/state/format.h"
#include "ui/state/view_geometry.h"

namespace dmoscope::ui {
namespace {

using render::in_quality_range;

/// Greatest number of qualities to be sorted without a delay; an even sample of more draws the same curve.
constexpr Index kMostSorted = 65536;

void refresh_input(Derived& derived, const Frame& frame) {
  derived.metrics = usable_metrics(frame.input->mesh);
  derived.mesh_facts = frame.input->report.sentences();
  derived.interfaces = frame.input->interfaces.sentence("interfaces: free");
  for (const std::string& offer : frame.input->interfaces.offers("materials"))
    derived.interfaces += (derived.interfaces.empty() ? "" : "; ") + offer;
  const Index held = frame.input->interfaces.count();
  derived.free_interfaces = held == 0 ? std::string()
                                      : fmt::format("{} on interfaces may move (interfaces: fixed keeps {})",
                                                    counted(held, "vertex", "vertices"), held == 1 ? "it" : "them");
  derived.groups = group_lines(frame.input->mesh);
  std::string left_out = left_out_of_pictures(frame.input->report.seam_elements, frame.input->geometry.plane);
  if (!left_out.empty()) derived.mesh_facts.push_back(std::move(left_out));
  derived.kinds.fill(0);
  for (const ElementKind kind : frame.input->mesh.elements.kinds()) ++derived.kinds[static_cast<std::size_t>(kind)];
}

/// Finds the groups that stay because the user said so.
void refresh_fixed_groups(Derived& derived, const Frame& frame, std::span<const Index> fixed) {
  derived.groups_fixed_by.assign(fixed.begin(), fixed.end());
  derived.groups_fixed.assign(frame.input->mesh.groups.size(), false);
  if (fixed.empty()) return;
  std::vector<bool> stays(frame.vertex_count(), false);
  for (const Index v : fixed)
    if (v < stays.size()) stays[v] = true;
  for (std::size_t g = 0; g < derived.groups_fixed.size(); ++g) {
    const std::vector<Index> vertices = vertices_of(frame.input->mesh, frame.input->mesh.groups[g]);
    derived.groups_fixed[g] = !vertices.empty() && std::ranges::all_of(vertices, [&](Index v) { return stays[v]; });
  }
}

/// Number of elements that have a quality.
Index counted_elements(const Histogram& histogram) {
  return std::accumulate(histogram.counts.begin(), histogram.counts.end(), histogram.below + histogram.above);
}

void widen(std::map<Metric, std::pair<double, double>>& seen, Metric metric, std::pair<double, double> range) {
  const auto [at, added] = seen.try_emplace(metric, range);
  if (!added) at->second = {std::min(at->second.first, range.first), std::max(at->second.second, range.second)};
}

/// Counts the elements outside the colours' range and those that count, in one pass.
void count_elements(Derived& derived, const ViewState& state, const Frame& frame) {
  derived.outside_low = derived.outside_high = 0;
  derived.undefined = frame.device && counted_elements(frame.now) < frame.element_count();
  derived.colouring.counting.reset();
  const render::Selection selection = selection_of(state, derived);
  const auto [low, high] = derived.range;
  std::size_t counting = 0;
  for (std::size_t e = 0; e < frame.quality.size(); ++e) {
    const auto q = static_cast<double>(frame.quality[e]);
    if (std::isnan(q)) {
      derived.undefined = true;
    } else if (frame.inverted[e] == 0) {
      // Quality is shown in float: a hair of tolerance so that 1.0000001 is not "above 1".
      derived.outside_low += q < low - 1e-6 ? 1 : 0;
      derived.outside_high += q > high + 1e-6 ? 1 : 0;
    }
    if (selection.members && (*selection.members)[e] == 0) continue;
    counting += !selection.quality || in_quality_range(*selection.quality, shade_of(frame.quality[e], frame.inverted[e] != 0)) ? 1 : 0;
  }
  if (!selection.all() && !frame.device) derived.colouring.counting = counting;
}

/// Finds the range of all frames on show; looks at each once.
bool refresh_own(ColourFacts& facts, std::span<const std::shared_ptr<const Frame>> frames, const Frame& active) {
  std::vector<std::pair<std::uint64_t, std::optional<std::pair<double, double>>>> owns;
  const auto add = [&](const Frame& frame) {
    const auto known = std::ranges::find(facts.owns, frame.serial, [](const auto& own) { return own.first; });
    owns.emplace_back(frame.serial, known == facts.owns.end() ? own_range(frame) : known->second);
    if (owns.back().second) widen(facts.seen, frame.shown, *owns.back().second);
  };
  for (const auto& frame : frames) add(*frame);
  if (frames.empty()) add(active);
  if (facts.owns == owns) return false;
  facts.owns = std::move(owns);
  facts.own.reset();
  for (const auto& [serial, own] : facts.owns) {
    if (!own) continue;
    const auto [low, high] = facts.own.value_or(*own);
    facts.own = {std::min(low, own->first), std::max(high, own->second)};
  }
  return true;
}

/// Distribution of the qualities of all inputs on show together, so that colours mean the same in all viewports.
std::shared_ptr<const InputSpread> spread_of_inputs(std::span<const std::shared_ptr<const Frame>> frames, const Frame& active) {
  std::vector<std::shared_ptr<const InputSpread>> spreads{active.input_spread};
  for (const auto& frame : frames)
    if (frame->shown == active.shown && std::ranges::find(spreads, frame->input_spread) == spreads.end())
      spreads.push_back(frame->input_spread);
  if (std::ranges::find(spreads, nullptr) != spreads.end()) return nullptr;
  if (spreads.size() == 1) return active.input_spread;
  auto all = std::make_shared<InputSpread>();
  for (const auto& spread : spreads) all->add(*spread);
  return all;
}

void refresh_range(Derived& derived, const ViewState& state, const Frame& frame, std::span<const std::shared_ptr<const Frame>> frames,
                   bool new_frame) {
  ColourFacts& facts = derived.colouring;
  const ColourFacts::RangeKey key{state.range_mode,        state.range_low,          state.range_high,
                                  state.range_low_percent, state.range_high_percent, state.colouring.held_range,
                                  state.colouring.filter,  facts.members.get()};
  if (!new_frame && facts.range_key == key) return;
  facts.range_key = key;
  const auto seen = facts.seen.find(frame.shown);
  derived.range = colour_range(state, facts.own, seen == facts.seen.end() ? std::nullopt : std::optional(seen->second),
                               spread_of_inputs(frames, frame).get());
  count_elements(derived, state, frame);
}

/// Calls `visit` with every element of an even sample.
template <class Visit>
void for_sample(const Frame& frame, Visit visit) {
  const Index size = frame.element_count(), step = std::max<Index>(1, (size + kMostSorted - 1) / kMostSorted);
  for (Index e = 0; e < size; e += step) visit(e);
}

/// Sorted qualities by a histogram, through the edges of its bins; elements below lie at the lower edge, but the worst at its value.
std::vector<double> sorted_by_histogram(const Frame& frame) {
  constexpr int kPoints = 512;
  const Histogram& histogram = frame.now;
  const double width = (histogram.highest - histogram.lowest) / static_cast<double>(Histogram::kBins);
  const double all = counted_elements(histogram);
  std::vector<double> curve;
  std::size_t bin = 0;
  double before = histogram.below;  // number of elements before the bin
  for (int k = 0; k < kPoints && all > 0; ++k) {
    const double rank = all * (k + 0.5) / kPoints;
    while (bin < Histogram::kBins && before + histogram.counts[bin] <= rank) before += histogram.counts[bin++];
    const double within = bin < Histogram::kBins ? std::clamp((rank - before) / histogram.counts[bin], 0.0, 1.0) : 0.0;
    curve.push_back(histogram.lowest + (static_cast<double>(bin) + within) * width);
  }
  if (!curve.empty()) curve.front() = frame.shown_statistics.minimum;
  return curve;
}

void refresh_sorted(Derived& derived, const Frame& frame) {
  const std::pair before_key{frame.input_serial, frame.shown};
  if (derived.sorted_before_key != before_key || derived.sorted_before.empty()) {
    derived.sorted_before.clear();
    const QualityContext context = frame.input->quality_context();
    for_sample(frame, [&](Index e) {
      const double before = element_quality(context, frame.input->mesh.positions, frame.shown, e);
      if (!std::isnan(before)) derived.sorted_before.push_back(before);
    });
    std::sort(derived.sorted_before.begin(), derived.sorted_before.end());
    derived.sorted_before_key = before_key;
  }
  if (frame.device) {
    derived.sorted_now = sorted_by_histogram(frame);
    return;
  }
  derived.sorted_now.clear();
  for_sample(frame, [&](Index e) {
    if (!std::isnan(frame.quality[e])) derived.sorted_now.push_back(static_cast<double>(frame.quality[e]));
  });
  std::sort(derived.sorted_now.begin(), derived.sorted_now.end());
}

}  // namespace

void refresh_members(ColourFacts& facts, const ViewState& state, const SessionView& session) {
  const Frame& frame = *session.frame;
  const ColouringState& colouring = state.colouring;
  const Colouring* classes = session.runs.empty() ? nullptr : session.runs[session.active].colouring.get();
  const bool by_frame = colouring.worst > 0 || (colouring.isolated && colouring.isolated->by == ColourBy::Inverted);
  const ColourFacts::MembersKey key{colouring.isolated, colouring.worst, frame.input_serial, by_frame ? frame.serial : 0,
                                    colouring.isolated ? classes : nullptr};
  if (facts.members_key == key) return;
  facts.members_key = key;
  facts.members = members_of(colouring, frame, session.runs.empty() ? nullptr : &session.runs[session.active]);
}

void refresh(Derived& derived, const ViewState& state, const SessionView& session, std::span<const std::shared_ptr<const Frame>> frames) {
  const Frame* frame = session.frame.get();
  if (frame == nullptr) {
    derived = {};
    return;
  }
  if (derived.input_serial != frame->input_serial) {
    refresh_input(derived, *frame);
    refresh_fixed_groups(derived, *frame, {});
    derived.colouring.seen.clear();
    derived.colouring.owns.clear();
    derived.input_serial = frame->input_serial;
  }
  if (session.active < session.runs.size()) {
    const std::vector<Index>& fixed = session.runs[session.active].parameters.fixed;
    if (derived.groups_fixed_by != fixed) refresh_fixed_groups(derived, *frame, fixed);
  }
  const bool new_frame = derived.frame_serial != frame->serial;
  derived.frame_serial = frame->serial;
  refresh_members(derived.colouring, state, session);
  const bool new_range = refresh_own(derived.colouring, frames, *frame);
  refresh_range(derived, state, *frame, frames, new_frame || new_range);
  const std::pair facts_key{frame->serial, state.picked};
  if (derived.facts_key != facts_key) {
    derived.facts = facts_of(*frame, state.picked);
    derived.facts_key = facts_key;
  }
  if (new_frame) {
    const Statistics& shown = frame->shown_statistics;
    derived.worst_angles = shown.minimum > 0.0 ? angles_of(*frame, shown.worst_element) : std::nullopt;
    derived.sorted_now.clear();
  }
  if (state.plot == PlotTab::Sorted && derived.sorted_now.empty()) refresh_sorted(derived, *frame);
}

render::ColourScale colour_scale(const ViewState& state, const Derived& derived) {
  return {state.colour_map, state.colouring.reversed, state.colouring.steps, derived.range.first, derived.range.second};
}

render::ColourScale shown_scale(const ViewState& state, const Derived& derived) {
  render::ColourScale scale = colour_scale(state, derived);
  const ColourFacts& facts = derived.colouring;
  if (facts.colours) {
    std::tie(scale.low, scale.high) = facts.values_range.value_or(facts.colours->range);
    // Maps show low values of quality brightly; of other values the high ones are sought.
    if (render::low_is_bright(scale.map)) scale.reversed = !scale.reversed;
  }
  if (facts.colours && facts.colours->centred) {
    scale.map = render::ColourMap::OrangeBlue;
    scale.reversed = false;
  }
  return scale;
}

render::Selection selection_of(const ViewState& state, const Derived& derived) {
  render::Selection selection;
  if (const auto& filter = state.colouring.filter) {
    selection.quality = {static_cast<float>(filter->first), static_cast<float>(filter->second)};
  }
  selection.members = derived.colouring.members;
  selection.others = state.colouring.others;
  return selection;
}

render::Legend legend_of(const ViewState& state, const Derived& derived, const Frame& frame) {
  render::Legend legend;
  const ElementColours* colours = derived.colouring.colours.get();
  legend.title = colours == nullptr ? metric_phrase(frame.shown) : state.panes.one() ? colours->title : colours->common_title;
  legend.inverted = frame.shown_statistics.inverted;
  if (colours == nullptr) {
    legend.undefined = derived.undefined;
    legend.below = derived.outside_low;
    legend.above = derived.outside_high;
  } else {
    legend.logarithmic = colours->logarithmic;
    legend.has_categories = has_categories(colours->by);
    if (colours->diverging && state.panes.one()) {
      legend.beside = {{"better", render::sample(render::ColourMap::OrangeBlue, 0.9), colours->better},
                       {"worse", render::sample(render::ColourMap::OrangeBlue, 0.1), colours->worse}};
    }
    for (const Category& category : colours->beside) legend.beside.push_back({category.name, category.colour, category.count});
    for (const Category& category : colours->categories) legend.categories.push_back({category.name, category.colour, category.count});
  }
  if (derived.colouring.counting) {
    const auto others = state.colouring.others;
    legend.selection = fmt::format("{} of {} elements{}", count(*derived.colouring.counting), count(frame.element_count()),
                                   others == render::Selection::Others::Fade ? ", others faded" : "");
  }
  return legend;
}

}  // namespace dmoscope::ui
