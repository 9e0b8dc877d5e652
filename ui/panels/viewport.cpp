// Centre: the mesh, what is written over it, and the mouse.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ui/format.h"
#include "ui/inspection_text.h"
#include "ui/panels/panels.h"
#include "ui/ticks.h"

namespace dmoscope::ui {
namespace {

Vec2<double> mouse_in(const Rect& rect) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  return {static_cast<double>(mouse.x - rect.x), static_cast<double>(mouse.y - rect.y)};
}

/// Text on a plate in the panel's colour, readable on any mesh.
void plate(const PanelContext& context, ImVec2 low, ImVec2 high) {
  ImGui::GetWindowDrawList()->AddRectFilled(low, high, colour(context.palette.panel, 0.90F), context.px(5));
}

/// What is shown of stepping and selecting, below the title.
void draw_note(const PanelContext& context, ImVec2 at, float most) {
  if (context.stepping_note.empty()) return;
  const float pad = context.px(8);
  const std::string note = fit_text(context.stepping_note, most - 2 * pad);
  plate(context, at, {at.x + 2 * pad + ImGui::CalcTextSize(note.c_str()).x, at.y + ImGui::GetTextLineHeight() + pad});
  ImGui::GetWindowDrawList()->AddText({at.x + pad, at.y + pad / 2}, colour(context.palette.dim), note.c_str());
}

void draw_title(PanelContext& context, const Rect& rect, const Frame& frame) {
  const RunView* run = context.run();
  if (run == nullptr) return;
  const float pad = context.px(8), line = ImGui::GetTextLineHeight();
  std::string title = fmt::format("{} · {}", run->parameters.method, metric_phrase(run->parameters.metric));
  const Mark* mark = context.state.timeline.shown_mark();
  if (mark != nullptr) title = fmt::format("{} · {}", context.state.timeline.shown == Shown::A ? "A" : "B", mark->title);
  std::string moment = fmt::format("it {}", count(frame.moment.iteration));
  if (frame.moment.visits > 0) moment += fmt::format(" + {} of {} visits", count(frame.moment.visits), count(run->visits_per_iteration));
  if (frame.moment.edits > 0) moment += fmt::format(" + {} by hand", count(frame.moment.edits));
  std::string shown;
  if (frame.shown != run->parameters.metric) shown = fmt::format("shown: {}", metric_phrase(frame.shown));
  if (context.activity.reduced) shown += shown.empty() ? "reduced detail" : " · reduced detail";

  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImGui::PushFont(context.fonts.bold);
  const float title_width = ImGui::CalcTextSize(title.c_str()).x;
  ImGui::PopFont();
  const float moment_width = ImGui::CalcTextSize(moment.c_str()).x;
  float width = 3 * pad + context.px(14) + title_width + moment_width;
  if (!shown.empty()) width += 2 * pad + ImGui::CalcTextSize(shown.c_str()).x;
  const ImVec2 at{rect.x + pad, rect.y + pad};
  plate(context, at, {at.x + width, at.y + line + pad});
  float x = at.x + pad;
  const float y = at.y + pad / 2;
  list.AddRectFilled({x, y + 0.2F * line}, {x + context.px(8), y + 0.8F * line}, colour(context.palette.runs[frame.run % 8]),
                     context.px(2));
  x += context.px(14);
  list.AddText(context.fonts.bold, context.em(), {x, y}, colour(context.palette.text), title.c_str());
  x += title_width + pad;
  list.AddText({x, y}, colour(context.palette.text), moment.c_str());
  if (!shown.empty()) list.AddText({x + moment_width + 2 * pad, y}, colour(context.palette.warning), shown.c_str());
  draw_note(context, {at.x, at.y + line + 1.25F * pad}, rect.w - 2 * pad);
}

/// Which level is seen, at the upper left corner of its grid or as near to it as can be read.
void draw_level_label(PanelContext& context, const Rect& rect) {
  const InspectionState& state = context.state.inspection;
  const std::string label = state.open ? level_label(state, context.inspection) : std::string();
  if (label.empty()) return;
  const Inspection& inspection = context.inspection;
  Vec2<double> corner{inspection.box.low.x, inspection.box.high.y};
  if (!state.applied && !state.all_levels && state.level >= 1 && !inspection.trace->levels.empty()) {
    const TracedLevel& level = inspection.trace->levels[static_cast<std::size_t>(state.level - 1)];
    corner = {level.centre.x - level.size.x / 2, level.centre.y + level.size.y / 2};
  }
  const Vec2<double> pixel = context.state.camera.to_pixel(inspection.origin + corner, context.state.viewport);
  const ImVec2 size = ImGui::CalcTextSize(label.c_str());
  const float pad = context.px(6), line = size.y;
  const float highest = rect.y + 2 * line + 3 * pad, lowest = rect.y + rect.h - 6 * line;
  const float x =
      std::clamp(rect.x + static_cast<float>(pixel.x) - pad, rect.x + pad, std::max(rect.x + pad, rect.x + rect.w - size.x - 3 * pad));
  const float y = std::clamp(rect.y + static_cast<float>(pixel.y) - line - 4 * pad, highest, std::max(highest, lowest));
  plate(context, {x, y}, {x + size.x + 2 * pad, y + line + pad});
  ImGui::GetWindowDrawList()->AddText({x + pad, y + pad / 2}, colour(context.palette.text), label.c_str());
}

/// The candidate under the mouse, in words; the inspector marks it, too.
void read_candidate(PanelContext& context, const Rect& rect) {
  InspectionState& state = context.state.inspection;
  if (!state.open || state.applied || state.all_levels || state.level < 1 || !context.inspection.trace || !ImGui::IsItemHovered()) return;
  const VisitTrace& trace = *context.inspection.trace;
  if (static_cast<std::size_t>(state.level) > trace.levels.size()) return;
  const TracedLevel& level = trace.levels[static_cast<std::size_t>(state.level - 1)];
  const Vec2<double> mouse = mouse_in(rect);
  double nearest = 9.0 * context.state.scale;  // pixels
  for (int index = 0; index < level.points * level.points; ++index) {
    const Vec2<double> way = context.state.camera.to_pixel(context.inspection.origin + level.at(index), context.state.viewport) - mouse;
    if (std::hypot(way.x, way.y) >= nearest) continue;
    nearest = std::hypot(way.x, way.y);
    state.hovered = CandidateName{state.level, index};
  }
  if (state.hovered && !ImGui::IsAnyMouseDown()) next_item_tooltip(candidate_text(trace, level, state.hovered->index));
}

void draw_bar_colours(const PanelContext& context, ImVec2 low, ImVec2 high) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  render::ColourScale scale;
  scale.map = context.state.colour_map;
  constexpr int kParts = 64;
  for (int k = 0; k < kParts; ++k) {
    const float a = static_cast<float>(k) / kParts, b = static_cast<float>(k + 1) / kParts;
    const ImU32 left = colour(scale.colour(static_cast<double>(a))), right = colour(scale.colour(static_cast<double>(b)));
    list.AddRectFilledMultiColor({low.x + a * (high.x - low.x), low.y}, {low.x + b * (high.x - low.x), high.y}, left, right, right, left);
  }
}

void draw_colour_bar(PanelContext& context, const Rect& rect, const Frame& frame) {
  const float pad = context.px(8), line = ImGui::GetTextLineHeight(), bar = std::round(0.8F * line);
  const auto range = context.derived.range;
  const std::string title = metric_phrase(frame.shown);
  std::vector<std::pair<std::string, render::Rgb>> notes;  // swatches to the right of the bar
  const Index inverted = frame.shown_statistics.inverted;
  if (inverted > 0) notes.emplace_back(fmt::format("{} inverted", count(inverted)), render::kInvertedColour);
  if (context.derived.undefined) notes.emplace_back("not defined", render::kUndefinedColour);
  std::string outside;
  if (context.derived.outside_low > 0) outside += fmt::format("{} below", count(context.derived.outside_low));
  if (context.derived.outside_high > 0)
    outside += fmt::format("{}{} above", outside.empty() ? "" : ", ", count(context.derived.outside_high));

  float extra = 0;
  for (const auto& [text, ink] : notes) extra += bar + context.px(6) + ImGui::CalcTextSize(text.c_str()).x + 2 * pad;
  const float width = std::clamp(rect.w * 0.42F, 10 * context.em(), 30 * context.em());
  const float whole = std::min(rect.w - 2 * pad, width + extra + 4 * pad);
  const ImVec2 low{rect.x + pad, rect.y + rect.h - pad - (2.2F * line + bar + 1.5F * pad)};
  plate(context, low, {low.x + whole, rect.y + rect.h - pad});

  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float left = low.x + 2 * pad, top = low.y + 0.6F * pad;
  list.AddText({left, top}, colour(context.palette.text), title.c_str());
  if (!outside.empty()) {
    const float outside_width = ImGui::CalcTextSize(outside.c_str()).x;
    list.AddText({left + width - outside_width, top}, colour(context.palette.dim), outside.c_str());
  }
  const float bar_top = top + 1.15F * line;
  draw_bar_colours(context, {left, bar_top}, {left + width, bar_top + bar});
  for (const Tick& tick : linear_ticks(range.first, range.second, std::max(2, static_cast<int>(width / (5 * line))))) {
    const float x = left + static_cast<float>((tick.value - range.first) / (range.second - range.first)) * width;
    list.AddLine({x, bar_top + bar}, {x, bar_top + bar + context.px(3)}, colour(context.palette.text), 1.0F);
    const float half = ImGui::CalcTextSize(tick.label.c_str()).x / 2;
    list.AddText({x - half, bar_top + bar + context.px(3)}, colour(context.palette.text), tick.label.c_str());
  }
  float x = left + width + 2 * pad;
  for (const auto& [text, ink] : notes) {
    list.AddRectFilled({x, bar_top}, {x + bar, bar_top + bar}, colour(ink), context.px(2));
    list.AddText({x + bar + context.px(6), bar_top - 0.1F * line}, colour(context.palette.text), text.c_str());
    x += bar + context.px(6) + ImGui::CalcTextSize(text.c_str()).x + 2 * pad;
  }
}

void pick_at(PanelContext& context, Vec2<double> pixel) {
  const auto [vertex, element] = context.pick(pixel);
  if (vertex != kNoIndex && !ImGui::GetIO().KeyAlt) {
    context.send(fmt::format("pick vertex {}", vertex));
    const RunView* run = context.run();
    const bool is_free = run != nullptr && vertex < run->fixed.size() && run->fixed[vertex] == 0;
    if (context.state.stepping.click_smooths && is_free && !context.activity.busy) context.send(fmt::format("visit {}", vertex));
  } else if (element != kNoIndex) {
    context.send(fmt::format("pick element {}", element));
  } else {
    context.send("pick none");
  }
}

void draw_context_menu(PanelContext& context) {
  if (!ImGui::BeginPopup("viewport menu")) return;
  const auto [vertex, element] = context.widgets.under_menu;
  if (vertex != kNoIndex) {
    if (ImGui::MenuItem(fmt::format("Select vertex {}", vertex).c_str())) context.send(fmt::format("pick vertex {}", vertex));
    if (ImGui::MenuItem(fmt::format("Look into the search of vertex {}", vertex).c_str()))
      context.send(fmt::format("inspect vertex {}", vertex));
    if (ImGui::MenuItem(fmt::format("Copy id {}", vertex).c_str())) context.send(fmt::format("copy {}", vertex));
  }
  if (element != kNoIndex) {
    if (ImGui::MenuItem(fmt::format("Select element {}", element).c_str())) context.send(fmt::format("pick element {}", element));
    if (ImGui::MenuItem(fmt::format("Why is element {} so? Look at its worst corner", element).c_str()))
      context.send(fmt::format("inspect element {}", element));
    if (ImGui::MenuItem(fmt::format("Go to element {}", element).c_str())) context.send(fmt::format("goto element {}", element));
  }
  if (vertex != kNoIndex || element != kNoIndex) ImGui::Separator();
  for (const char* id : {"step-iteration", "run-pause", "reset", "fit", "wireframe", "vertices", "worst-marker", "screenshot"}) {
    const Action& action = *find_action(id);
    if (ImGui::MenuItem(std::string(action.title).c_str(), std::string(action.key).c_str(), false, enabled(action, context.situation()))) {
      context.send(std::string(action.command));
    }
  }
  ImGui::EndPopup();
}

void handle_mouse(PanelContext& context, const Rect& rect) {
  const ImGuiIO& io = ImGui::GetIO();
  ViewState& state = context.state;
  const Vec2<double> at = mouse_in(rect);
  const bool hovered = ImGui::IsItemHovered();
  if (hovered && io.MouseWheel != 0) {
    state.camera.zoom_at(at, state.viewport, std::pow(1.2, static_cast<double>(io.MouseWheel)));
    context.widgets.moved_at = context.now;
  }
  if (ImGui::IsItemActivated()) context.widgets.dragged = false;
  const bool painting = handle_brush(context, rect, at);
  for (const int button : {ImGuiMouseButton_Left, ImGuiMouseButton_Middle}) {
    if (painting && button == ImGuiMouseButton_Left) continue;
    if (!ImGui::IsItemActive() || !ImGui::IsMouseDragging(button, context.widgets.dragged ? 0.0F : context.px(4))) continue;
    // The first drag event carries the way from the press on, so that the grabbed point stays under the cursor.
    const ImVec2 move = context.widgets.dragged ? io.MouseDelta : ImGui::GetMouseDragDelta(button, 0.0F);
    context.widgets.dragged = true;
    state.camera.pan({static_cast<double>(move.x), static_cast<double>(move.y)});
    if (move.x != 0 || move.y != 0) context.widgets.moved_at = context.now;
  }
  if (painting) {
    // Neither a pick nor a fit.
  } else if (hovered && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
    context.send("fit");
  } else if (hovered && ImGui::IsMouseReleased(ImGuiMouseButton_Left) && ImGui::IsItemDeactivated() && !context.widgets.dragged) {
    pick_at(context, at);
  }
  if (hovered && ImGui::IsMouseReleased(ImGuiMouseButton_Right)) {
    context.widgets.under_menu = context.pick(at);
    ImGui::OpenPopup("viewport menu");
  }
}

}  // namespace

void draw_viewport(PanelContext& context, const Rect& rect) {
  context.state.inspection.hovered.reset();
  if (rect.empty()) return;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, colour_vector(context.palette.background));
  begin_panel("viewport", rect, false, context.frame() == nullptr);
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
  const Frame* frame = context.frame();
  if (frame == nullptr) {
    draw_start_page(context, rect);
    end_panel();
    return;
  }
  if (context.mesh_texture != 0) {
    ImGui::GetWindowDrawList()->AddImage(reinterpret_cast<ImTextureID>(std::uintptr_t{context.mesh_texture}), {rect.x, rect.y},
                                         {rect.x + rect.w, rect.y + rect.h}, {0, 1}, {1, 0});
  }
  ImGui::InvisibleButton("mesh", {rect.w, rect.h},
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle | ImGuiButtonFlags_MouseButtonRight);
  context.items.record_last("viewport");
  read_candidate(context, rect);
  handle_mouse(context, rect);
  draw_field_in_view(context, rect);
  draw_level_label(context, rect);
  draw_title(context, rect, *frame);
  draw_colour_bar(context, rect, *frame);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {context.px(8), context.px(8)});
  draw_context_menu(context);
  ImGui::PopStyleVar();
  end_panel();
}

}  // namespace dmoscope::ui
