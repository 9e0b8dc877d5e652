// Below the viewport: plots.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "ui/panels/panels.h"
#include "ui/plots/plot_builder.h"
#include "ui/plots/plot_widget.h"
#include "ui/state/view_options.h"

namespace dmoscope::ui {
namespace {

/// Draws the words of an option of the view as entries of a menu.
void draw_choices(PanelContext& context, std::string_view command) {
  const ViewOption& option = view_option(command);
  for (std::size_t k = 0; k < option.at.choices.size(); ++k) {
    const auto value = static_cast<double>(k);
    if (!option.at.is_offered(context.state, value)) continue;
    const std::string title(option.at.choices[k].title);
    if (ImGui::MenuItem(title.c_str(), nullptr, option.now(context.state) == value))
      context.send(fmt::format("{} {}", command, option.at.choices[k].word));
    note_item(context, "plot-menu:" + title, std::string(option.at.choices[k].doc));
  }
  ImGui::Separator();
}

/// Draws all choices of the plot, in a popup that is open.
void draw_plot_menu(PanelContext& context) {
  const PlotTab plot = context.state.plot;
  for (const char* command : {"x-axis", "plot-x"})
    if (over_iterations(plot)) draw_choices(context, command);
  for (const char* command : {"histogram-range", "plot-bins"})
    if (plot == PlotTab::Histogram) draw_choices(context, command);
  draw_choices(context, "axis");
  for (const char* id : {"plot-all", "plot-copy", "plot-save"}) action_entry(context, id);
  ImGui::EndPopup();
}

/// Draws the buttons that choose the plot.
void draw_plot_tabs(PanelContext& context) {
  const ViewOption& plot = view_option("plot");
  // Narrow panels leave room for the button with the choices.
  const float gap = context.px(4), number = static_cast<float>(plot.at.choices.size());
  float words = widest_button({"…"}) + gap * number + context.px(8);
  for (const OptionChoice& tab : plot.at.choices) words += ImGui::CalcTextSize(std::string(tab.title).c_str()).x;
  const ImVec2 usual = ImGui::GetStyle().FramePadding;
  const float pad = std::clamp((ImGui::GetContentRegionAvail().x - words) / (2 * number), context.px(2), usual.x);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {std::floor(pad), usual.y});
  for (const OptionChoice& tab : plot.at.choices) {
    if (&tab != plot.at.choices.data()) ImGui::SameLine(0, gap);
    const bool active = plot.word(plot.now(context.state)) == tab.word;
    ImGui::PushStyleColor(ImGuiCol_Button, active ? colour_vector(context.palette.accent, 0.25F) : ImVec4{0, 0, 0, 0});
    action_button(context, fmt::format("plot-{}", tab.word), std::string(tab.title).c_str());
    ImGui::PopStyleColor();
  }
  ImGui::PopStyleVar();
}

/// Draws the menu of the plot's axes at the right end of the tabs' line, and beside it what saves the plot; `rect`: of the panel.
void draw_plot_controls(PanelContext& context, const Rect& rect) {
  ImGui::SameLine();
  const float gap = context.px(8), start = ImGui::GetCursorPosX(), end = rect.w - context.px(12);
  const float both = widest_button({"Axes ▾"}) + gap + widest_button({"Save…"});
  const bool roomy = end - start > both;
  ImGui::SetCursorPosX(std::max(start, end - (roomy ? both : widest_button({"…"}))));
  if (ImGui::Button(roomy ? "Axes ▾" : "…")) ImGui::OpenPopup("axes of the plot");
  note_item(context, "plot-axes", "what lies along the plot, and on which scales");
  if (ImGui::BeginPopup("axes of the plot")) draw_plot_menu(context);
  if (!roomy) return;
  ImGui::SameLine(0, gap);
  action_button(context, "plot-save", "Save…");
}

}  // namespace

void draw_plot_area(PanelContext& context, std::optional<Range> inside) {
  if (!context.widgets.plot) context.widgets.plot = std::make_shared<PlotCache>();
  PlotCache& cache = *context.widgets.plot;
  const ViewState& state = context.state;
  const SortedQualities sorted{context.derived.sorted_before, context.derived.sorted_now};
  std::string key = plot_key(state, context.session, sorted) + fmt::format(" {}", static_cast<int>(state.theme));
  if (key != cache.plot_key) {
    cache.plot_key = std::move(key);
    cache.plot = build_plot(state, context.session, sorted, context.palette);
  }
  const PlotOutcome outcome = draw_plot(cache, context.state.plot_view(), context.palette, state.scale, context.items, inside);
  for (const std::string& line : outcome.commands) context.send(line);
  const RunView* run = context.run();
  if (outcome.clicked && over_iterations(state.plot) && run != nullptr && !context.activity.busy)
    context.send(fmt::format("seek {}", iteration_at(*run, state.plot_options.by_seconds, *outcome.clicked)));
  if (outcome.menu) ImGui::OpenPopup("menu of the plot");
  if (ImGui::BeginPopup("menu of the plot")) draw_plot_menu(context);
}

void draw_plots(PanelContext& context, const Layout& layout) {
  const Rect& rect = layout.bottom;
  if (rect.empty()) return;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {context.px(12), context.px(6)});
  begin_panel("plots", rect);
  ImGui::PopStyleVar();
  draw_plot_tabs(context);
  draw_plot_controls(context, rect);
  // The keyboard goes into the table, not into plots, because it would leave a frame around them.
  const ImGuiWindowFlags keys =
      context.state.plot == PlotTab::Runs || context.state.plot == PlotTab::Compare ? ImGuiWindowFlags_None : ImGuiWindowFlags_NoNav;
  ImGui::BeginChild("plot area", {0, std::max(1.0F, ImGui::GetContentRegionAvail().y)}, false,
                    keys | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  if (context.state.plot == PlotTab::Runs) {
    draw_run_table(context);
  } else if (context.state.plot == PlotTab::Compare) {
    draw_comparison(context);
  } else {
    const TimelineRoom below = timeline_room(context, layout);
    draw_plot_area(context, below.below_plot ? std::optional(Range{below.left, below.right}) : std::nullopt);
  }
  ImGui::EndChild();
  end_panel();
}

}  // namespace dmoscope::ui
