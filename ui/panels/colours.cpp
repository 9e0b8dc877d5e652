// Left: what the elements' colours tell, which elements count, and what is written on them.
#include <algorithm>

#include <fmt/format.h>

#include "ui/analysis/element_colours.h"
#include "ui/panels/panels.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

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

  option_row(context, "worst-view");
  option_row(context, "filter-mode");

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
  option_rows(context, "map");
  draw_range(context);
  if (context.state.in_space) option_rows(context, "depth");
  option_row(context, "labels");
  ImGui::Dummy({0, context.px(4)});
  heading(context, "Filter");
  draw_filter(context);
}

}  // namespace dmoscope::ui
