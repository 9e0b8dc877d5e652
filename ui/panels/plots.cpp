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

struct Choice {
  std::string label, command, tip;
  bool chosen;
};

float box_width(const std::vector<Choice>& choices) {
  float width = 0;
  for (const Choice& choice : choices) width = std::max(width, ImGui::CalcTextSize(choice.label.c_str()).x);
  return width + 2 * ImGui::GetStyle().FramePadding.x + ImGui::GetFrameHeight();
}

/// Draws a combo box of commands, as wide as its widest label; its entries are the items "ITEM:LABEL".
void choice_box(PanelContext& context, const char* item, const std::vector<Choice>& choices) {
  ImGui::SetNextItemWidth(box_width(choices));
  const auto now = std::ranges::find(choices, true, &Choice::chosen);
  Combo combo(context, item, now == choices.end() ? std::string() : now->label);
  if (!combo.open() && now != choices.end()) next_item_tooltip(now->tip);
  for (const Choice& choice : choices)
    if (combo.open() && combo.entry(choice.label, choice.label, choice.chosen, choice.tip)) context.send(choice.command);
}

std::vector<Choice> option_choices(const ViewState& state, std::string_view command) {
  const ViewOption& option = view_option(command);
  std::vector<Choice> choices;
  for (std::size_t k = 0; k < option.at.choices.size(); ++k) {
    if (!option.at.is_offered(state, static_cast<double>(k))) continue;
    const OptionChoice& one = option.at.choices[k];
    choices.push_back({std::string(one.title), fmt::format("{} {}", command, one.word), std::string(one.doc),
                       option.now(state) == static_cast<double>(k)});
  }
  return choices;
}

std::vector<Choice> along_choices(const ViewState& state) {
  if (over_iterations(state.plot)) return option_choices(state, "plot-x");
  return state.plot == PlotTab::Histogram ? option_choices(state, "plot-bins") : std::vector<Choice>();
}

std::vector<Choice> x_choices(const ViewState& state) {
  if (state.plot == PlotTab::Histogram) return option_choices(state, "histogram-range");
  return over_iterations(state.plot) ? option_choices(state, "x-axis") : std::vector<Choice>();
}

void draw_choices(PanelContext& context, const char* item, const std::vector<Choice>& choices) {
  for (const Choice& choice : choices) {
    if (ImGui::MenuItem(choice.label.c_str(), nullptr, choice.chosen)) context.send(choice.command);
    note_item(context, fmt::format("{}:{}", item, choice.label), choice.tip);
  }
  if (!choices.empty()) ImGui::Separator();
}

/// Draws all choices of the plot. `item`: prefix of the choices' names.
void draw_plot_menu(PanelContext& context, const char* item) {
  draw_choices(context, item, x_choices(context.state));
  draw_choices(context, item, along_choices(context.state));
  if (const auto axes = option_choices(context.state, "axis"); axes.size() > 1) draw_choices(context, item, axes);
  for (const char* id : {"plot-all", "plot-copy", "plot-save"}) action_entry(context, id);
}

void draw_more_menu(PanelContext& context) {
  if (ImGui::Button("…")) ImGui::OpenPopup("more of the plot");
  context.items.record_last("plot-more");
  if (!ImGui::BeginPopup("more of the plot")) return;
  draw_plot_menu(context, "plot-menu");
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

/// Draws the shown plot's choices at the right end of the tabs' line; `rect`: of the panel.
void draw_plot_controls(PanelContext& context, const Rect& rect) {
  struct Box {
    const char* item;
    std::vector<Choice> choices;
  };
  std::vector<Box> boxes{{"plot-x", x_choices(context.state)},
                         {"plot-axis", option_choices(context.state, "axis")},
                         {"plot-along", along_choices(context.state)}};
  std::erase_if(boxes, [](const Box& box) { return box.choices.size() < 2; });  // no choice
  const float gap = context.px(8), buttons = widest_button({"Copy data"}) + gap + widest_button({"Save…"});
  ImGui::SameLine();
  const float start = ImGui::GetCursorPosX(), room = rect.w - context.px(12) - start;
  const auto wide = [&](float last) {
    float sum = last;
    for (const Box& box : boxes) sum += box_width(box.choices) + gap;
    return sum;
  };
  const bool roomy = room > wide(buttons);
  while (!boxes.empty() && room < wide(widest_button({"…"}))) boxes.erase(boxes.begin());  // they are in the menu, too
  ImGui::SetCursorPosX(std::max(start, rect.w - context.px(12) - wide(roomy ? buttons : widest_button({"…"}))));
  for (const Box& box : boxes) {
    choice_box(context, box.item, box.choices);
    ImGui::SameLine(0, gap);
  }
  if (!roomy) return draw_more_menu(context);
  action_button(context, "plot-copy", "Copy data");
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
  if (!ImGui::BeginPopup("menu of the plot")) return;
  draw_plot_menu(context, "plot-menu");
  ImGui::EndPopup();
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
