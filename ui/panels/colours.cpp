// Left: what the elements' colours tell, which elements count, and what is written on them.
#include <algorithm>

#include <fmt/format.h>

#include "ui/analysis/element_colours.h"
#include "ui/panels/panels.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

/// One of some words, sent as "COMMAND word".
template <class Value, std::size_t N>
void word_combo(PanelContext& context, const char* item, const std::array<std::pair<std::string_view, Value>, N>& words,
                const std::array<const char*, N>& titles, Value now, const char* command) {
  std::size_t current = 0;
  for (std::size_t k = 0; k < N; ++k) current = words[k].second == now ? k : current;
  Combo combo(context, item, titles[current]);
  for (std::size_t k = 0; combo.open() && k < N; ++k)
    if (combo.entry(words[k].first, titles[k], k == current)) context.send(fmt::format("{} {}", command, words[k].first));
}

void draw_colour_by(PanelContext& context) {
  labelled(context, "colours", "what the elements' colours tell");
  const ColourBy now = context.state.colouring.by;
  Combo combo(context, "color-by", std::string(info(now).title), ImGuiComboFlags_HeightLarge);
  if (!combo.open()) return;
  const bool no_groups = context.session.input && context.session.input->mesh.groups.empty();
  for (const ColourByInfo& one : kColourBys) {
    const auto not_drawn = context.session.input ? why_not_drawn(one.by, *context.session.input) : std::nullopt;
    const bool possible = !not_drawn && (one.by != ColourBy::Group || !no_groups);
    if (combo.entry(one.name, one.title, one.by == now,
                    possible    ? std::string(one.doc)
                    : not_drawn ? *not_drawn
                                : "the mesh has no groups or markers",
                    possible))
      context.send(fmt::format("color-by {}", one.name));
  }
}

void draw_map(PanelContext& context) {
  labelled(context, "map", "perceptually uniform and colour-blind safe");
  if (Combo combo(context, "colormap", std::string(render::name(context.state.colour_map))); combo.open())
    for (const auto& map : render::colour_map_table())
      if (combo.entry(map.name, map.name, map.map == context.state.colour_map, std::string(map.doc)))
        context.send(fmt::format("colormap {}", map.name));
  labelled(context, "reversed", "the colour map from its other end");
  option_box(context, "##reversed", "reverse-colors", "reverse-colors", context.state.colouring.reversed);
  labelled(context, "steps", "so many colours of equal width; 0: without steps");
  int steps = context.state.colouring.steps;
  ImGui::InputInt("##color-steps", &steps, 1, 1, ImGuiInputTextFlags_EnterReturnsTrue);
  context.items.record_last("color-steps");
  const int before = context.state.colouring.steps;
  if (steps != before && (ImGui::IsItemDeactivatedAfterEdit() || !ImGui::IsItemActive())) {
    // One colour is none: the buttons step over it.
    context.send(fmt::format("color-steps {}", steps == 1 ? (before == 0 ? 2 : 0) : std::clamp(steps, 0, 64)));
  }
}

void draw_range(PanelContext& context) {
  labelled(context, "range", "qualities that the colours span; the ends of the colour bar can be dragged");
  const bool given = context.state.range_mode == RangeMode::Given;
  const auto now = context.derived.range;
  if (Combo combo(context, "range", std::string(info(context.state.range_mode).title)); combo.open())
    for (const RangeModeInfo& one : kRangeModes)
      if (combo.entry(one.name, one.title, one.mode == context.state.range_mode, std::string(one.doc)))
        context.send(one.mode == RangeMode::Given ? fmt::format("range {} {}", full_number(now.first), full_number(now.second))
                                                  : fmt::format("range {}", one.name));
  if (context.state.range_mode == RangeMode::Percentile) {
    labelled(context, "per cent", "elements of the input that the colours leave out below, and those up to which they reach");
    pair_field(context, "range-percent", context.state.range_low_percent, context.state.range_high_percent, "range percentile");
  }
  if (!given) return;
  labelled(context, "from, to", "lowest and highest quality of the colours");
  pair_field(context, "range-given", context.state.range_low, context.state.range_high, "range");
}

/// What shows the form of a volume besides its edges.
void draw_depth(PanelContext& context) {
  labelled(context, "corners", "a little darker in corners, by a fifth at most, with lines along sharp edges");
  option_box(context, "##occlusion", "occlusion", "occlusion", context.state.occlusion);
  labelled(context, "light", "lit by a lamp: shows the form, but changes what the colours tell");
  option_box(context, "##shading", "shading", "shading", context.state.shading);
}

void draw_filter(PanelContext& context) {
  const ColouringState& state = context.state.colouring;
  labelled(context, "quality", "only elements from the first to the second quality count; inverted ones when the first is 0 or less",
           11 * context.em());
  const auto range = state.filter.value_or(std::pair{0.0, 1.0});
  const float clear = ImGui::CalcTextSize("off").x + 2 * ImGui::GetStyle().FramePadding.x;
  ImGui::SetNextItemWidth(std::max(6 * context.em(), ImGui::GetContentRegionAvail().x - clear - context.px(6)));
  pair_field(context, "filter", range.first, range.second, "filter");
  ImGui::SameLine(0, context.px(6));
  ImGui::BeginDisabled(!state.filter);
  if (ImGui::Button("off##filter")) context.send("filter off");
  context.items.record_last("filter-off");
  ImGui::EndDisabled();
  next_item_tooltip("all qualities count");

  labelled(context, "worst", "only so many of the worst elements count; 0: all");
  int worst = state.worst;
  ImGui::InputInt("##worst", &worst, 1, 10, ImGuiInputTextFlags_EnterReturnsTrue);
  context.items.record_last("worst-view");
  if (worst != state.worst && (ImGui::IsItemDeactivatedAfterEdit() || !ImGui::IsItemActive())) {
    context.send(worst <= 0 ? std::string("worst-view off") : fmt::format("worst-view {}", std::min(worst, 100)));
  }

  labelled(context, "others", "how elements that do not count are drawn");
  word_combo(context, "filter-mode", kFilterModes, {"faded", "hidden", "outlines"}, state.others, "filter-mode");

  if (state.isolated) {
    dim_text(context, fmt::format("only {}: {}", info(state.isolated->by).name, state.isolated->name));
    ImGui::SameLine();
    if (ImGui::SmallButton("off##isolate")) context.send("isolate off");
    context.items.record_last("isolate-off");
  }
  if (context.derived.colouring.counting && context.frame() != nullptr) {
    value_row(context, "these count",
              fmt::format("{} of {}", count(*context.derived.colouring.counting), count(context.frame()->element_count())));
  }
}

}  // namespace

void draw_colours(PanelContext& context) {
  if (context.run() == nullptr) return;
  ImGui::Dummy({0, context.px(4)});
  heading(context, "Colours");
  draw_colour_by(context);
  labelled(context, "metric", "of colours, histogram and worst list", metric_combo_width(context));
  metric_combo(context, "shown", context.session.shown, "show");
  draw_map(context);
  draw_range(context);
  if (context.state.in_space) draw_depth(context);
  labelled(context, "labels", "ids, where there is room for them and nothing hides what they name");
  static constexpr std::array<std::pair<std::string_view, int>, 4> kLabels{{{"off", 0}, {"vertices", 1}, {"elements", 2}, {"both", 3}}};
  const ColouringState& state = context.state.colouring;
  word_combo(context, "labels", kLabels, {"none", "vertices", "elements", "both"},
             (state.label_vertices ? 1 : 0) + (state.label_elements ? 2 : 0), "labels");
  ImGui::Dummy({0, context.px(4)});
  heading(context, "Filter");
  draw_filter(context);
}

}  // namespace dmoscope::ui
