// Centre: the mesh, what is written over it, and the mouse.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/drawing/ticks.h"
#include "ui/format.h"
#include "ui/inspection_text.h"
#include "ui/panels/panels.h"
#include "ui/size_point.h"

namespace dmoscope::ui {
namespace {

Vec2<double> mouse_in(const Rect& rect) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  return {static_cast<double>(mouse.x - rect.x), static_cast<double>(mouse.y - rect.y)};
}

/// What is shown of stepping and selecting, below the title.
void draw_note(const PanelContext& context, ImVec2 at, float most) {
  if (context.stepping_note.empty()) return;
  const float pad = context.px(8);
  const std::string note = fit_text(context.stepping_note, most - 2 * pad);
  draw_plate(context, at, {at.x + 2 * pad + ImGui::CalcTextSize(note.c_str()).x, at.y + ImGui::GetTextLineHeight() + pad});
  ImGui::GetWindowDrawList()->AddText({at.x + pad, at.y + pad / 2}, colour(context.palette.dim), note.c_str());
}

void draw_title(PanelContext& context, const Rect& rect, const Frame& frame) {
  const RunView* run = context.run();
  if (run == nullptr) return;
  const float pad = context.px(8), line = ImGui::GetTextLineHeight();
  std::string title = fmt::format("{} · {}", run->parameters.method, metric_phrase(run->parameters.metric));
  if (run->parameters.combination) title = run->title;
  if (run->mean_since && *run->mean_since < frame.moment.iteration) title += ", then mean";
  const Mark* mark = context.state.timeline.shown_mark();
  if (mark != nullptr) title = fmt::format("{} · {}", context.state.timeline.shown == Shown::A ? "A" : "B", mark->title);
  std::string moment = fmt::format("it {}", count(frame.moment.iteration));
  if (frame.moment.visits > 0) moment += fmt::format(" + {} of {} visits", count(frame.moment.visits), count(run->visits_per_iteration));
  if (frame.moment.edits > 0) moment += fmt::format(" + {}", counted(frame.moment.edits, "edit", "edits"));
  std::string shown;
  if (frame.shown != run->parameters.metric) shown = fmt::format("shown: {}", metric_phrase(frame.shown));
  const auto add = [&](const char* note) { shown += (shown.empty() ? "" : " · ") + std::string(note); };
  if (context.activity.reduced) add("reduced detail");
  if (context.derived.colouring.labels_lack_room) add("zoom in for labels");

  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImGui::PushFont(context.fonts.bold);
  const float title_width = ImGui::CalcTextSize(title.c_str()).x;
  ImGui::PopFont();
  const float moment_width = ImGui::CalcTextSize(moment.c_str()).x;
  float width = 3 * pad + context.px(14) + title_width + moment_width;
  if (!shown.empty()) width += 2 * pad + ImGui::CalcTextSize(shown.c_str()).x;
  const ImVec2 at{rect.x + pad, rect.y + pad};
  draw_plate(context, at, {at.x + width, at.y + line + pad});
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
  draw_plate(context, {x, y}, {x + size.x + 2 * pad, y + line + pad});
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

void pick_at(PanelContext& context, Vec2<double> pixel) {
  if (context.state.placing_size_point) {
    context.state.placing_size_point = false;
    context.send(size_point_command(context.state, context.session.input->geometry.plane, pixel));
    return;
  }
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

/// "Copy quality 0.8123": all its digits.
void copy_entry(PanelContext& context, const std::string& what, const std::string& shown, const std::string& full) {
  if (ImGui::MenuItem(fmt::format("Copy {} {}", what, shown).c_str())) context.send("copy " + quote_word(full));
  context.items.record_last("copy:" + what);
}

void draw_vertex_entries(PanelContext& context, Index vertex) {
  if (ImGui::MenuItem(fmt::format("Select vertex {}", vertex).c_str())) context.send(fmt::format("pick vertex {}", vertex));
  if (ImGui::MenuItem(fmt::format("Look into the search of vertex {}", vertex).c_str()))
    context.send(fmt::format("inspect vertex {}", vertex));
  const PickedFacts& facts = context.widgets.vertex_under_menu;
  copy_entry(context, "vertex id", fmt::format("{}", vertex), fmt::format("{}", vertex));
  if (facts.picked.kind == Picked::Kind::None) return;  // a device that tells nothing
  const Vec3 at = facts.at;
  copy_entry(context, "vertex coordinates", fmt::format("{:.6g}, {:.6g}", at.x, at.y),
             fmt::format("{} {} {}", full_number(at.x), full_number(at.y), full_number(at.z)));
  copy_entry(context, "vertex quality", short_number(facts.now), full_number(facts.now));
}

void draw_element_entries(PanelContext& context, Index element) {
  if (ImGui::MenuItem(fmt::format("Select element {}", element).c_str())) context.send(fmt::format("pick element {}", element));
  if (ImGui::MenuItem(fmt::format("Why is element {} so? Look at its worst corner", element).c_str()))
    context.send(fmt::format("inspect element {}", element));
  if (ImGui::MenuItem(fmt::format("Go to element {}", element).c_str())) context.send(fmt::format("goto element {}", element));
  copy_entry(context, "element id", fmt::format("{}", element), fmt::format("{}", element));
  const Frame& frame = *context.frame();
  if (element >= frame.element_count()) return;  // another mesh has come
  for (const PickedFacts::Row& row : context.widgets.element_under_menu.metrics) {
    if (row.metric == &info(frame.shown)) copy_entry(context, "element quality", short_number(row.now), full_number(row.now));
  }
  const auto corners = frame.input->mesh.elements.corners(element);
  copy_entry(context, "corners", fmt::format("{}", fmt::join(corners, ", ")), fmt::format("{}", fmt::join(corners, " ")));
}

void draw_context_menu(PanelContext& context) {
  if (!ImGui::BeginPopup("viewport menu")) return;
  const auto [vertex, element] = context.widgets.under_menu;
  if (vertex != kNoIndex) draw_vertex_entries(context, vertex);
  if (vertex != kNoIndex && element != kNoIndex) ImGui::Separator();
  if (element != kNoIndex) draw_element_entries(context, element);
  if (vertex != kNoIndex || element != kNoIndex) ImGui::Separator();
  for (const char* id : {"smooth-selected", "fix-selected", "step-iteration", "run-pause", "reset", "fit", "wireframe", "vertices",
                         "worst-marker", "screenshot"}) {
    const Action& action = *find_action(id);
    if (action.needs == Needs::Selected && !context.situation().selected) continue;
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
    const auto [vertex, element] = context.widgets.under_menu;
    const Frame& frame = *context.frame();
    context.widgets.vertex_under_menu = facts_of(frame, {vertex == kNoIndex ? Picked::Kind::None : Picked::Kind::Vertex, vertex});
    context.widgets.element_under_menu = facts_of(frame, {element == kNoIndex ? Picked::Kind::None : Picked::Kind::Element, element});
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
  handle_colour_bar(context, rect);
  ImGui::SetCursorScreenPos({rect.x, rect.y});
  ImGui::InvisibleButton("mesh", {rect.w, rect.h},
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle | ImGuiButtonFlags_MouseButtonRight);
  context.items.record_last("viewport");
  read_candidate(context, rect);
  handle_mouse(context, rect);
  draw_labels(context, rect);
  draw_field_in_view(context, rect);
  draw_level_label(context, rect);
  draw_title(context, rect, *frame);
  draw_colour_bar(context, rect);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {context.px(8), context.px(8)});
  draw_context_menu(context);
  ImGui::PopStyleVar();
  end_panel();
}

}  // namespace dmoscope::ui
