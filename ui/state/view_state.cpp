#include "ui/state/view_state.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/run/parameters.h"

namespace dmoscope::ui {
namespace {

/// Prefixes of the names of a tab's controls; the first that fits counts.
constexpr std::array<std::pair<std::string_view, FactsTab>, 36> kHomes{
    {{"worst:", FactsTab::Worst},        {"why:", FactsTab::Worst},        {"why?", FactsTab::Worst},
     {"color-", FactsTab::Colours},      {"colormap", FactsTab::Colours},  {"reverse-colors", FactsTab::Colours},
     {"range-menu", FactsTab::Mesh},  // part of the legend
     {"range-", FactsTab::Colours},      {"occlusion", FactsTab::Colours}, {"shading", FactsTab::Colours},
     {"labels", FactsTab::Colours},      {"filter", FactsTab::Colours},    {"worst-view", FactsTab::Colours},
     {"isolate-off", FactsTab::Colours}, {"shown", FactsTab::Colours},     {"inside:", FactsTab::Inside},
     {"from:", FactsTab::Inside},        {"group-", FactsTab::Mesh},       {"loop-next", FactsTab::Selection},
     {"loop-back", FactsTab::Selection}, {"loop-", FactsTab::Mesh},        {"reference", FactsTab::Colours},
     {"held-by", FactsTab::Mesh},        {"show-worst", FactsTab::Mesh},   {"star:", FactsTab::Selection},
     {"metric:", FactsTab::Selection},   {"why", FactsTab::Selection},     {"kind:", FactsTab::Selection},
     {"edge:", FactsTab::Selection},     {"chain:", FactsTab::Selection},  {"place:", FactsTab::Selection},
     {"inspect", FactsTab::Selection},   {"level", FactsTab::Selection},   {"candidate", FactsTab::Selection},
     {"element:", FactsTab::Selection},  {"field", FactsTab::Selection}}};
/// Controls of the settings that are not rows of parameter_table().
constexpr std::array<std::string_view, 8> kSettings{"target", "then-", "combine", "backend", "threads", "seed", "size", "threshold"};

bool is_setting(std::string_view item) {
  const auto is = [item](std::string_view name) { return !name.empty() && item.starts_with(name); };
  if (item == "method" || item.starts_with("method:") || item.starts_with("method-") || item.starts_with("metric")) return false;
  return std::ranges::any_of(kSettings, is) ||
         std::ranges::any_of(parameter_table(), [&](const ParameterInfo& row) { return is(row.item.empty() ? row.name : row.item); });
}

}  // namespace

void Panels::show_selection(bool in_list) {
  picked_over = true;
  if (tab == FactsTab::Selection || (in_list && tab == FactsTab::Worst)) return;
  tab_before = tab;
  tab = FactsTab::Selection;
}

void Panels::leave_selection() {
  picked_over = false;
  if (tab == FactsTab::Selection) tab = tab_before;
}

namespace {

/// Upper end of the highest bin that is not empty.
double highest_of(const Histogram& histogram) {
  if (histogram.above > 0) return histogram.highest;
  const auto last = std::find_if(histogram.counts.rbegin(), histogram.counts.rend(), [](Index count) { return count > 0; });
  const auto bins = static_cast<double>(histogram.counts.rend() - last);
  return histogram.lowest + bins * (histogram.highest - histogram.lowest) / static_cast<double>(Histogram::kBins);
}

}  // namespace

std::optional<std::pair<double, double>> own_range(const Frame& frame) {
  double low = INFINITY, high = -INFINITY;
  if (frame.device) {
    low = frame.shown_statistics.minimum;
    high = highest_of(frame.now);
  }
  for (const float q : frame.quality) {
    if (!std::isfinite(q)) continue;
    low = std::min(low, static_cast<double>(q));
    high = std::max(high, static_cast<double>(q));
  }
  low = std::max(low, 0.0);  // inverted elements have their own colour
  return high >= low ? std::optional(std::pair{low, high}) : std::nullopt;
}

std::pair<double, double> colour_range(const ViewState& state, std::optional<std::pair<double, double>> own,
                                       std::optional<std::pair<double, double>> seen, const InputSpread* input) {
  if (state.colouring.held_range) return *state.colouring.held_range;
  if (state.range_mode == RangeMode::Given) return {state.range_low, state.range_high};
  std::optional<std::pair<double, double>> wanted;
  if (state.range_mode == RangeMode::Auto) wanted = own;
  if (state.range_mode == RangeMode::Expanding) wanted = seen;
  if (state.range_mode == RangeMode::Input && input != nullptr) wanted = input->range_without_tail();
  if (state.range_mode == RangeMode::Percentile && input != nullptr)
    wanted = input->percentiles(state.range_low_percent, state.range_high_percent);
  const bool tidied = state.range_mode == RangeMode::Input || state.range_mode == RangeMode::Percentile;
  if (tidied && input == nullptr) wanted = own;
  if (wanted && tidied) return tidy_range(*wanted);
  return wanted && wanted->second > wanted->first ? *wanted : std::pair{0.0, 1.0};
}

void ViewState::link_cameras(bool linked) {
  if (panes.linked && !linked) {
    for (Pane& pane : panes.panes) pane.camera = camera;
  }
  panes.linked = linked;
}

void ViewState::focus_pane(std::size_t pane) {
  if (!panes.linked && pane != panes.focus) {
    panes.panes[panes.focus].camera = camera;
    camera = panes.panes[pane].camera;
  }
  panes.focus = pane;
}

void ViewState::follow(const SessionView& session) {
  in_space = session.input && session.input->in_space();
  focus_pane(panes.follow(session));
  PaneContent& reference = colouring.reference;
  using Kind = PaneContent::Kind;
  const bool gone = (reference.kind == Kind::Run && std::ranges::find(panes.run_ids, reference.run) == panes.run_ids.end()) ||
                    (reference.kind == Kind::MarkA && !timeline.a.frame) || (reference.kind == Kind::MarkB && !timeline.b.frame);
  if (gone) reference = {Kind::Input, 0, std::nullopt};
  const auto has_begun = [](const RunView& run) { return run.records.size() > 1 || run.moment != Moment{}; };
  const bool shows_input = plot == PlotTab::Histogram || plot == PlotTab::Sorted;
  if (shows_input || std::ranges::any_of(session.runs, has_begun)) panels.plots_wait = false;
  if (const auto changed = run_names.follow(session); !changed.empty())
    for (PlotView& view : plots) rename_runs(view, changed);
}

void ViewState::set_layout(PaneLayout layout) {
  focus_pane(std::min(panes.focus, pane_count(layout) - 1));
  panes.set_layout(layout);
}

void ViewState::show_comparison(std::size_t runs) {
  plot = PlotTab::Compare;
  panels.bottom = true;
  panels.plots_wait = false;
  const PaneLayout wanted = runs == 2 ? PaneLayout::Two : PaneLayout::Four;
  if (runs > panes.count() && runs <= pane_count(PaneLayout::Four)) set_layout(wanted);
}

void move_to_monitor(ViewState& state, double monitor_scale) {
  if (!(monitor_scale > 0.0) || monitor_scale == state.monitor_scale) return;
  state.scale = std::clamp(state.scale * monitor_scale / state.monitor_scale, 0.5, 4.0);
  state.monitor_scale = monitor_scale;
}

void add_message(ViewState& state, Message message) {
  constexpr std::size_t kMost = 200;
  if (message.kind == Message::Kind::Error) {
    if (state.dialog == Dialog::Error && !state.error_text.empty()) {
      state.error_text += "\n\n" + message.text;
    } else {
      state.error_text = message.text;
      state.dialog = Dialog::Error;
    }
  }
  ++state.messages;
  state.commands.say(message);
  state.result.say(message);
  state.log.push_back(std::move(message));
  while (state.log.size() > kMost) state.log.pop_front();
}

void remember_file(ViewState& state, const std::string& file) {
  constexpr std::size_t kMost = 10;
  std::error_code unknown;
  const std::filesystem::path whole = std::filesystem::weakly_canonical(std::filesystem::absolute(file, unknown), unknown);
  const std::string path = unknown ? file : whole.string();
  std::erase(state.recent_files, path);
  state.recent_files.insert(state.recent_files.begin(), path);
  if (state.recent_files.size() > kMost) state.recent_files.resize(kMost);
}

void open_home_of(std::string_view item, Panels& panels) {
  panels.notice = panels.notice || item.starts_with("notice:");
  const auto home = std::ranges::find_if(kHomes, [item](const auto& one) { return item.starts_with(one.first); });
  if (is_setting(item) && home == kHomes.end()) {
    panels.settings = panels.setup = true;
  } else if (home != kHomes.end() && !item.starts_with("range-menu")) {
    panels.tab = home->second;
    panels.facts = true;
    panels.holds = panels.holds || item.starts_with("held-by");
  }
}

}  // namespace dmoscope::ui
