#include "ui/commands/view_to_commands.h"

#include <utility>

#include <fmt/format.h>

#include "ui/commands/clipping_text.h"
#include "ui/state/view_options.h"

namespace dmoscope::ui {
namespace {

std::string range_line(const ViewState& state) {
  if (state.range_mode == RangeMode::Given) return fmt::format("range {} {}", state.range_low, state.range_high);
  const std::string_view name = info(state.range_mode).name;
  if (state.range_mode != RangeMode::Percentile) return fmt::format("range {}", name);
  return fmt::format("range {} {} {}", name, state.range_low_percent, state.range_high_percent);
}

}  // namespace

std::vector<std::string> view_lines(const ViewState& state, bool with_camera) {
  std::vector<std::string> lines;
  if (state.window_size.first > 0) lines.push_back(fmt::format("size {} {}", state.window_size.first, state.window_size.second));
  lines.push_back(fmt::format("scale {}", state.scale));
  // Default values are written, too: the settings of the person who runs the script may differ.
  for (const ViewOption& option : view_options())
    if (option.kept.in_scripts && (option.entry.needs != Needs::Volume || state.in_space))
      lines.push_back(option_line(state, option.command));
  if (!state.panels.plots_wait) lines.push_back(option_line(state, "panel bottom"));
  lines.push_back(range_line(state));
  const PlotView& plot = state.plots[static_cast<std::size_t>(state.plot)];
  for (const auto& [axis, range] : {std::pair{"x", plot.x_range}, {"y", plot.y_range}})
    lines.push_back(range ? fmt::format("plot-zoom {} {} {}", axis, range->first, range->second) : fmt::format("plot-zoom {} all", axis));
  const Panes& panes = state.panes;
  for (std::size_t k = 0; k < panes.count() && !panes.one(); ++k) {
    const Pane& pane = panes.panes[k];
    lines.push_back(fmt::format("pane {} {}", k + 1, pane.chosen ? panes.words(pane.content) : "auto"));
    if (panes.linked || k == panes.focus || !with_camera) continue;
    lines.push_back(fmt::format("pane-camera {} {} {} {}", k + 1, pane.camera.centre.x, pane.camera.centre.y, pane.camera.units_per_pixel));
  }
  if (!panes.one()) lines.push_back(fmt::format("focus-pane {}", panes.focus + 1));
  if (state.in_space) {
    for (std::string& line : inside_lines(state, with_camera)) lines.push_back(std::move(line));
    return lines;
  }
  const render::Camera2D& camera = state.camera;
  if (with_camera) lines.push_back(fmt::format("camera {} {} {}", camera.centre.x, camera.centre.y, camera.units_per_pixel));
  return lines;
}

}  // namespace dmoscope::ui
