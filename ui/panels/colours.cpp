// Left: meaning of the elements' colours, choice of those that count, and labels on them.
#include <algorithm>

#include <fmt/format.h>

#include "ui/analysis/element_colours.h"
#include "ui/panels/panels.h"
#include "ui/state/format.h"
#include "ui/state/run_names.h"

namespace dmoscope::ui {
namespace {

void draw_colour_by(PanelContext& context) {
  labelled(context, "colours", "what the colours of the elements mean");
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

/// Draws the choice of the reference of differences: the input, a run at its present state, or a mark.
void draw_reference(PanelContext& context) {
  using Kind = PaneContent::Kind;
  const PaneContent& now = context.state.colouring.reference;
  const auto title_of_run = [&](std::size_t k) { return run_title(context.session, k); };
  const auto& runs = context.session.runs;
  const auto at = std::ranges::find(runs, now.run, &RunView::id);
  const std::string shown = now.kind == Kind::MarkA                     ? "mark A"
                            : now.kind == Kind::MarkB                   ? "mark B"
                            : now.kind == Kind::Run && at != runs.end() ? title_of_run(static_cast<std::size_t>(at - runs.begin()))
                                                                        : "the input";
  labelled(context, "less that of", "the mesh that is compared with, element by element", 12 * context.em());
  Combo combo(context, "reference", context.shown(shown));
  if (!combo.open()) return;
  const auto entry = [&](const std::string& words, const std::string& title, bool chosen, bool possible, const char* why) {
    if (combo.entry(words, context.shown(title), chosen, possible ? "" : why, possible)) context.send("color-by difference " + words);
  };
  entry("input", "the input", now.kind == Kind::Input, true, "");
  for (std::size_t k = 0; k < runs.size(); ++k)
    entry(fmt::format("run {}", k + 1), title_of_run(k), now.kind == Kind::Run && now.run == runs[k].id, k != context.session.active,
          "this run itself");
  const Timeline& timeline = context.state.timeline;
  entry("mark a", "mark A", now.kind == Kind::MarkA, timeline.a.frame != nullptr, "nothing is marked as A yet");
  entry("mark b", "mark B", now.kind == Kind::MarkB, timeline.b.frame != nullptr, "nothing is marked as B yet");
}

/// Rows that have no effect on the present colours: they are grey and say why.
class GreyRows {
 public:
  GreyRows(bool grey, const char* why) : grey_(grey), why_(why) {
    ImGui::BeginGroup();
    ImGui::BeginDisabled(grey);
  }
  ~GreyRows() {
    ImGui::EndDisabled();
    ImGui::EndGroup();
    if (grey_) next_item_tooltip(why_);
  }
  GreyRows(const GreyRows&) = delete;
  GreyRows& operator=(const GreyRows&) = delete;

 private:
  bool grey_;
  const char* why_;
};

/// Whether colours come from a map. Categories have colours of their own unless they have an order; a difference has two, about its middle.
bool goes_by_map(ColourBy by) {
  return by == ColourBy::Valence || by == ColourBy::Freedom || (!has_categories(by) && by != ColourBy::Difference);
}

void draw_range(PanelContext& context) {
  labelled(context, "range", "the range of qualities that the colours cover; the ends of the colour bar can be dragged");
  const bool given = context.state.range_mode == RangeMode::Given;
  const auto now = context.derived.range;
  if (Combo combo(context, "range", std::string(info(context.state.range_mode).title)); combo.open())
    for (const RangeModeInfo& one : kRangeModes)
      if (combo.entry(one.name, one.title, one.mode == context.state.range_mode, std::string(one.doc)))
        context.send(one.mode == RangeMode::Given ? fmt::format("range {} {}", full_number(now.first), full_number(now.second))
                                                  : fmt::format("range {}", one.name));
  if (context.state.range_mode == RangeMode::Percentile) {
    labelled(context, "per cent", "percentiles of the input's qualities at the two ends of the colours");
    pair_field(context, "range-percent", context.state.range_low_percent, context.state.range_high_percent, "range percentile");
  }
  if (!given) return;
  labelled(context, "from, to", "lowest and highest quality of the colours");
  pair_field(context, "range-given", context.state.range_low, context.state.range_high, "range");
}

void draw_filter(PanelContext& context) {
  const ColouringState& state = context.state.colouring;
  labelled(context, "quality", "only elements with a quality in this range count; inverted ones when the lower end is 0 or less",
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
  {
    const GreyRows rows(!state.filter && !state.isolated && state.worst == 0, "all elements count, so there are no others");
    option_row(context, "filter-mode");
  }

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
  const ColourBy by = context.state.colouring.by;
  if (by == ColourBy::Difference) draw_reference(context);
  const char* own =
      by == ColourBy::Difference ? "differences: orange is worse, blue is better" : "these categories have colours of their own";
  {
    const GreyRows rows(!goes_by_map(by), own);
    option_row(context, "colormap");
    option_row(context, "reverse-colors");
  }
  {
    const GreyRows rows(!goes_by_map(by) && by != ColourBy::Difference, own);
    option_row(context, "color-steps");
  }
  {
    const GreyRows rows(by != ColourBy::Quality, "the range is for qualities, which the colours do not show now");
    draw_range(context);
  }
  if (context.state.in_space) option_rows(context, "depth");
  option_row(context, "labels");
  ImGui::Dummy({0, context.px(4)});
  heading(context, "Filter");
  draw_filter(context);
}

}  // namespace dmoscope::ui
