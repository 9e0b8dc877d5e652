// Right, for volume meshes: the visible part of the mesh, and the direction of view.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/quality/quality.h"
#include "ui/commands/clipping_commands.h"
#include "ui/panels/panels.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

/// The viewport that commands are about.
const PaneFacts* active_pane(const PanelContext& context) {
  for (const PaneFacts& pane : context.panes)
    if (pane.focus && pane.cells_seen) return &pane;
  return nullptr;
}

/// Ends a slider: the view follows it at once, and one command is sent when it is released. `show` changes the view, `line` is the command.
template <class Show, class Line>
void hold(PanelContext& context, bool changed, Show show, Line line) {
  InsideGrip& grip = context.widgets.inside_grip;
  ClippingView& view = context.state.inside;
  if (ImGui::IsItemActivated()) grip = {true, view, {}};
  if (changed) {
    show(view);
    context.widgets.moved_at = context.now;
  }
  if (!ImGui::IsItemDeactivated() || !grip.held) return;
  grip.held = false;
  if (view == grip.before) return;
  const std::string command = line();
  view = grip.before;  // only the command changes it
  context.send(command);
}

bool slider(const char* item, double& value, double low, double high, const char* format) {
  return ImGui::SliderScalar(fmt::format("##{}", item).c_str(), ImGuiDataType_Double, &value, &low, &high, format,
                             ImGuiSliderFlags_AlwaysClamp);
}

void draw_clip(PanelContext& context, const render::Bounds3& box) {
  ClipPlane& clip = context.state.inside.clip;
  const auto across = axis_plane(clip, box);
  labelled(context, "clip plane", "hides what lies on one side of a plane; drag its handle in the view   J");
  option_box(context, "##clip", "clip", "inside:clip");
  for (int axis = 0; axis < 3; ++axis) {
    ImGui::SameLine(0, context.px(5));
    const std::string name = axis_name(axis, false);
    const bool pressed = clip.on && across && across->axis == axis;
    if (lit_button(context, fmt::format("inside:{}", name), name, pressed,
                   "at right angles to this axis; the side towards the viewer is hidden"))
      context.send(fmt::format("clip {}:{:.4g}", axis_name(axis, looks_along(context.state.orbit, axis)),
                               clip.on && across ? std::clamp(across->fraction, 0.0, 1.0) : 0.5));
  }
  ImGui::BeginDisabled(!clip.on);
  labelled(context, "side", "the side that is hidden");
  const bool flipped = clip.on && across && across->flip;
  if (lit_button(context, "inside:flip", "flip", flipped, "hides the other side   Shift+J")) context.send("clip flip");
  // Rows that are grey without a plane keep their place, so that nothing below moves.
  labelled(context, "place", "from the lower to the upper end of the mesh; Ctrl+click to type");
  const auto ends = span_of(clip, box);
  const double low = ends.first, high = ends.second, span = high - low;
  double fraction = across ? across->fraction : span > 0.0 ? (clip.offset - low) / span : 0.5;
  const double side = across && clip.normal.x + clip.normal.y + clip.normal.z < 0.0 ? -1.0 : 1.0;
  const bool moved = slider("place", fraction, 0.0, 1.0, "%.3f");
  context.items.record_last("inside:place");
  hold(
      context, moved, [&](ClippingView& view) { view.clip.offset = side > 0.0 ? low + fraction * span : high - fraction * span; },
      [&] { return clip_command(clip, box); });
  labelled(context, "cells", "at the plane");
  const bool cut = clip.mode == ClipPlane::Mode::Cut;
  if (lit_button(context, "inside:whole", "whole", !cut, "cells that the plane passes through stay whole   Alt+J"))
    context.send("clip-mode crinkle");
  ImGui::SameLine(0, context.px(5));
  if (lit_button(context, "inside:cut", "cut", cut, "cells that the plane passes through are cut   Alt+J")) context.send("clip-mode cut");
  ImGui::EndDisabled();
}

void draw_peel(PanelContext& context) {
  ClippingView& view = context.state.inside;
  labelled(context, "layers off", "number of layers of cells that are peeled off the boundary   Y, Shift+Y; Ctrl+click to type");
  int layers = static_cast<int>(std::min<Index>(view.peel, 1'000'000));
  const float button = ImGui::GetFrameHeight(), gap = context.px(4);
  ImGui::SetNextItemWidth(std::max(4 * context.em(), ImGui::GetContentRegionAvail().x - 2 * (button + gap)));
  const bool moved = ImGui::SliderInt("##peel", &layers, 0, std::max(20, layers));
  context.items.record_last("inside:peel");
  hold(
      context, moved, [&](ClippingView& shown) { shown.peel = static_cast<Index>(std::max(layers, 0)); },
      [&] { return fmt::format("peel {}", view.peel); });
  ImGui::SameLine(0, gap);
  ImGui::BeginDisabled(view.peel == 0);
  if (ImGui::Button("-##peel", {button, 0})) context.send("peel less");
  context.items.record_last("inside:peel-less");
  ImGui::EndDisabled();
  ImGui::SameLine(0, gap);
  if (ImGui::Button("+##peel", {button, 0})) context.send("peel more");
  context.items.record_last("inside:peel-more");
}

/// Draws the choice of visible qualities: two sliders, each off at its end.
void draw_qualities(PanelContext& context) {
  ClippingView& view = context.state.inside;
  const MetricInfo& metric = info(context.session.shown);
  const double low = std::max(0.0, metric.lowest), high = metric.highest;
  const std::string tip = fmt::format("by the shown metric, {}; off at its end", metric_phrase(context.session.shown));
  labelled(context, "hide better", ("hides cells of a higher quality; inverted ones stay; " + tip).c_str());
  double most = view.peel_quality ? static_cast<double>(*view.peel_quality) : high;
  bool moved = slider("hide-better", most, low, high, view.peel_quality ? "> %.3f" : "off");
  context.items.record_last("inside:hide-better");
  const auto peel_to = [high](double value) { return value < high ? std::optional(static_cast<float>(value)) : std::nullopt; };
  hold(
      context, moved, [&](ClippingView& shown) { shown.peel_quality = peel_to(most); },
      [&] { return view.peel_quality ? fmt::format("peel-quality {:.4g}", *view.peel_quality) : std::string("peel-quality off"); });

  labelled(context, "hide worse", ("hides cells of a lower quality, and inverted ones; " + tip).c_str());
  double least = view.isolate ? static_cast<double>(view.isolate->first) : low;
  const float upper = view.isolate ? view.isolate->second : static_cast<float>(high);
  const bool hides_worse = view.isolate && static_cast<double>(view.isolate->first) > low;
  moved = slider("hide-worse", least, low, std::max(low, static_cast<double>(upper)), hides_worse ? "< %.3f" : "off");
  context.items.record_last("inside:hide-worse");
  hold(
      context, moved,
      [&](ClippingView& shown) {
        shown.isolate = least > low ? std::optional(std::pair{static_cast<float>(least), upper}) : std::nullopt;
      },
      [&] {
        return view.isolate ? fmt::format("keep-quality {:.4g} {:.4g}", view.isolate->first, view.isolate->second)
                            : std::string("keep-quality off");
      });
  // A script or a session can set a range that the sliders do not show.
  if (!view.isolate || static_cast<double>(upper) >= high) return;
  labelled(context, "kept", "cells of other qualities are hidden");
  if (ImGui::Button(fmt::format("{:.3g} to {:.3g}  ×##kept", view.isolate->first, upper).c_str())) context.send("keep-quality off");
  note_item(context, "inside:kept", "shows the other qualities again");
}

void draw_worst_cells(PanelContext& context) {
  const ClippingView& view = context.state.inside;
  std::size_t& wanted = context.widgets.worst_cells;
  if (view.worst > 0) wanted = view.worst;
  labelled(context, "only worst", "shows only this many of the worst cells, within a faint outline of the rest   Q");
  bool on = view.worst > 0;
  if (ImGui::Checkbox("##only-worst", &on)) context.send(on ? fmt::format("worst-cells {}", wanted) : "worst-cells off");
  context.items.record_last("inside:worst");
  ImGui::SameLine(0, context.px(5));
  ImGui::SetNextItemWidth(-1);
  int number = static_cast<int>(std::min<std::size_t>(wanted, 1'000'000));
  const int before = number;
  ImGui::InputInt("##worst-cells", &number, 10, 100, ImGuiInputTextFlags_EnterReturnsTrue);
  context.items.record_last("inside:worst-number");
  if (number != before && (ImGui::IsItemDeactivatedAfterEdit() || !ImGui::IsItemActive())) {
    wanted = static_cast<std::size_t>(std::max(number, 1));
    if (view.worst > 0) context.send(fmt::format("worst-cells {}", wanted));
  }
}

void draw_looks(PanelContext& context) {
  ClippingView& view = context.state.inside;
  option_row(context, "ghost-rest", "inside:ghost");
  labelled(context, "shrink", "draws every cell smaller about its middle, so that one can see between them   E");
  double shrink = view.shrink;
  const bool moved = slider("shrink", shrink, 0.1, 1.0, "%.2f");
  context.items.record_last("inside:shrink");
  hold(
      context, moved, [&](ClippingView& shown) { shown.shrink = std::clamp(shrink, 0.1, 1.0); },
      [&] { return fmt::format("shrink {:.3g}", view.shrink); });
}

void draw_from(PanelContext& context) {
  labelled(context, "look from", "shows the whole mesh from this side");
  const ImVec2 padding = ImGui::GetStyle().FramePadding;
  const float column = ImGui::GetCursorPosX();
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {context.px(3), padding.y});  // seven buttons in a row
  for (const render::ViewPresetInfo& preset : render::view_preset_table()) {
    const std::string name(preset.name);
    const float width = ImGui::CalcTextSize(name.c_str()).x + context.px(6);
    if (&preset != &render::view_preset_table().front()) ImGui::SameLine(0, context.px(3));
    if (ImGui::GetContentRegionAvail().x < width) {
      ImGui::NewLine();
      ImGui::SetCursorPosX(column);
    }
    if (ImGui::Button(fmt::format("{}##from", name).c_str(), {width, 0})) context.send("view-from " + name);
    note_item(context, "from:" + name, "shows the whole mesh from this side");
  }
  ImGui::PopStyleVar();
  option_box(context, "perspective", "perspective", "inside:perspective");
  ImGui::SameLine(0, context.px(12));
  option_box(context, "roll freely", "trackball", "inside:trackball");
  option_row(context, "up-axis", "inside:up");
}

}  // namespace

void draw_clipping(PanelContext& context) {
  const PaneFacts* pane = active_pane(context);
  if (!context.state.in_space || pane == nullptr) return;
  heading(context, "Inside");
  ImGui::SameLine();
  const std::size_t all = pane->frame()->element_count();
  const InspectionState& inspection = context.state.inspection;
  const bool searching = inspection.open && inspection.alone && context.inspection.solid && !inspection.applied;
  dim_text(context,
           searching                  ? "faint during an inspection"
           : *pane->cells_seen == all ? "all cells shown"
                                      : fmt::format("{} of {} cells", count(*pane->cells_seen), count(all)),
           false);
  note_item(context, "inside:count", "marks of hidden cells are faint");
  draw_clip(context, pane->box);
  draw_peel(context);
  draw_qualities(context);
  draw_worst_cells(context);
  draw_looks(context);
  draw_from(context);
  // Isolation in the histogram takes cells away, too.
  const ColouringState& colouring = context.state.colouring;
  const bool isolated = colouring.filter && colouring.others == render::Selection::Others::Hide;
  ImGui::BeginDisabled(context.state.inside == ClippingView{} && !isolated);
  if (ImGui::Button("Show all cells")) {
    context.send("show-all");
    if (isolated) context.send("filter off");
  }
  note_item(context, "inside:all", "removes the plane, peeling, shrinking and the range of the histogram   Z");
  ImGui::EndDisabled();
  ImGui::Dummy({0, context.px(4)});
}

}  // namespace dmoscope::ui
