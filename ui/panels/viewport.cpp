// Centre: the meshes, the text over them, and the mouse.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/drawing/ticks.h"
#include "ui/analysis/inspection_text.h"
#include "ui/commands/size_point.h"
#include "ui/overlays/inspection_marks.h"
#include "ui/panels/panels.h"
#include "ui/state/format.h"
#include "ui/state/run_names.h"

namespace dmoscope::ui {
namespace {

Vec2<double> mouse_in(const Rect& rect) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  return {static_cast<double>(mouse.x - rect.x), static_cast<double>(mouse.y - rect.y)};
}

/// Draws a note on stepping and selecting beside the title if there is room, else below it, in as many lines as it needs.
void draw_note(PanelContext& context, const PaneFacts& pane, const Rect& title) {
  const std::string& note = pane.stepping_note;
  const float pad = context.px(8), line = ImGui::GetTextLineHeight(), end = title.x + title.w + pad / 2,
              widest = pane.uncovered.w - 4 * pad;
  const bool beside = ImGui::CalcTextSize(note.c_str()).x <= title.x + title_room(context, pane) - end - 2 * pad,
             one = context.state.panes.one();
  const int below =
      note.empty() || beside || !one ? 0 : static_cast<int>(ImGui::CalcTextSize(note.c_str(), nullptr, false, widest).y / line);
  if (std::exchange(context.widgets.note_lines, below) != below) context.widgets.resized = true;
  if (note.empty() || !one) return;
  const ImVec2 at = beside ? ImVec2{end, title.y} : ImVec2{pane.uncovered.x + pad, pane.rect.y + line + 2.25F * pad};
  const Rect plate = draw_plate(context, at, note, context.palette.dim, pad, widest);
  context.items.record("note", {plate.x, plate.y, plate.x + plate.w, plate.y + plate.h});
}

/// Draws the name of the visible level at the upper left corner of its grid, or as near to it as can be read.
void draw_level_label(PanelContext& context, const PaneFacts& pane) {
  const Rect& rect = pane.rect;
  const InspectionState& state = context.state.inspection;
  const std::string label = state.open ? level_label(state, context.inspection) : std::string();
  if (label.empty()) return;
  const Inspection& inspection = context.inspection;
  Vec2<double> pixel;  // for a volume the upper left corner
  if (inspection.trace && !inspection.grid) {
    Vec2<double> corner{inspection.box.low.x, inspection.box.high.y};
    if (!state.applied && !state.all_levels && state.level >= 1 && !inspection.trace->levels.empty()) {
      const TracedLevel& level = inspection.trace->levels[static_cast<std::size_t>(state.level - 1)];
      corner = {level.centre.x - level.size.x / 2, level.centre.y + level.size.y / 2};
    }
    pixel = pane.camera.to_pixel(Vec2<double>{inspection.origin.x, inspection.origin.y} + corner, context.state.viewport);
  }
  const ImVec2 size = ImGui::CalcTextSize(label.c_str());
  const float pad = context.px(6), line = size.y;
  const float highest = rect.y + 2 * line + 3 * pad, lowest = rect.y + rect.h - 6 * line;
  const float x =
      std::clamp(rect.x + static_cast<float>(pixel.x) - pad, rect.x + pad, std::max(rect.x + pad, rect.x + rect.w - size.x - 3 * pad));
  const float y = std::clamp(rect.y + static_cast<float>(pixel.y) - line - 4 * pad, highest, std::max(highest, lowest));
  draw_plate(context, {x, y}, label, context.palette.text, pad);
}

/// Tells the candidate under the mouse in words; the inspector marks it, too. In a volume, candidates of the slice that the maps show go
/// before others.
void read_candidate(PanelContext& context, const PaneFacts& pane) {
  InspectionState& state = context.state.inspection;
  const Inspection& inspection = context.inspection;
  if (!state.open || state.applied || state.all_levels || state.level < 1 || !ImGui::IsItemHovered()) return;
  if (static_cast<std::size_t>(state.level) > inspection.level_count()) return;
  const GridSlice slice = shown_slice(state, inspection, state.level);
  const Vec2<double> viewport = context.state.viewport, mouse = mouse_in(pane.rect);
  const auto count = static_cast<int>(inspection.level(state.level).quality.size());
  for (const bool of_slice : {true, false}) {
    double nearest = (inspection.solid ? 6.0 : 9.0) * context.state.scale;  // pixels
    for (int index = 0; index < count; ++index) {
      if (slice.place(index).has_value() != of_slice) continue;
      const auto place = pane.view->place(inspection.origin + candidate_at(inspection, state.level, index));
      const double away = place ? std::hypot(0.5 * viewport.x + place->x - mouse.x, 0.5 * viewport.y - place->y - mouse.y) : nearest;
      if (away >= nearest) continue;
      nearest = away;
      state.hovered = CandidateName{state.level, index};
    }
    if (state.hovered) break;
  }
  if (state.hovered && !ImGui::IsAnyMouseDown()) next_item_tooltip(candidate_text(inspection, state.level, state.hovered->index));
}

/// Picks on a mesh that is not the active one, which it first becomes.
void pick_on_other_mesh(PanelContext& context, const PaneFacts& pane, Index vertex, Index element) {
  const auto run = std::ranges::find(context.session.runs, pane.session->input, &RunView::input);
  if (run == context.session.runs.end()) return;
  const bool has_run = pane.run() != nullptr && pane.run()->input == pane.session->input;
  const std::size_t place = has_run ? pane.session->active : static_cast<std::size_t>(run - context.session.runs.begin());
  context.send(fmt::format("select-run {}", place + 1));
  if (vertex != kNoIndex && !ImGui::GetIO().KeyAlt) {
    context.state.pick_on_switch = {Picked::Kind::Vertex, vertex};
  } else if (element != kNoIndex) {
    context.state.pick_on_switch = {Picked::Kind::Element, element};
  }
}

void pick_at(PanelContext& context, const PaneFacts& pane, Vec2<double> pixel) {
  ViewState& state = context.state;
  if (state.placing_size_point) {
    state.placing_size_point = false;
    if (pane.in_space()) return;  // only in a plane is a pixel a point
    const Vec2<double> there =
        state.camera.to_pixel(pane.camera.to_plane(pixel, state.viewport), state.viewport);  // in the active pane's pixels
    context.send(size_point_command(state, *context.session.input, there));
    return;
  }
  const auto [vertex, element] = context.pick(pane.number, pixel);
  if (pane.session->input != context.session.input) return pick_on_other_mesh(context, pane, vertex, element);
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

/// Draws an entry that copies a value with all its digits: "Copy quality 0.8123".
void copy_entry(PanelContext& context, const std::string& what, const std::string& shown, const std::string& full) {
  if (ImGui::MenuItem(fmt::format("Copy {} {}", what, shown).c_str())) context.send("copy " + quote_word(full));
  context.items.record_last("copy:" + what);
}

void draw_vertex_entries(PanelContext& context, Index vertex) {
  if (ImGui::MenuItem(fmt::format("Select vertex {}", vertex).c_str())) context.send(fmt::format("pick vertex {}", vertex));
  if (ImGui::MenuItem(fmt::format("Inspect the search of vertex {}", vertex).c_str()))
    context.send(fmt::format("inspect vertex {}", vertex));
  const PickedFacts& facts = context.widgets.vertex_under_menu;
  copy_entry(context, "vertex id", fmt::format("{}", vertex), fmt::format("{}", vertex));
  if (facts.picked.kind == Picked::Kind::None) return;  // the device cannot be read
  const Vec3 at = facts.at;
  const std::string height = context.state.in_space ? fmt::format(", {:.6g}", at.z) : "";
  copy_entry(context, "vertex coordinates", fmt::format("{:.6g}, {:.6g}{}", at.x, at.y, height),
             fmt::format("{} {} {}", full_number(at.x), full_number(at.y), full_number(at.z)));
  copy_entry(context, "vertex quality", short_number(facts.now), full_number(facts.now));
}

void draw_element_entries(PanelContext& context, Index element) {
  if (ImGui::MenuItem(fmt::format("Select element {}", element).c_str())) context.send(fmt::format("pick element {}", element));
  if (ImGui::MenuItem(fmt::format("Inspect the worst corner of element {}", element).c_str()))
    context.send(fmt::format("inspect element {}", element));
  if (ImGui::MenuItem(fmt::format("Go to element {}", element).c_str())) context.send(fmt::format("goto element {}", element));
  copy_entry(context, "element id", fmt::format("{}", element), fmt::format("{}", element));
  const std::size_t pane = context.widgets.menu_pane;
  const Frame* shown = pane < context.panes.size() ? context.panes[pane].frame() : nullptr;
  if (shown == nullptr || element >= shown->element_count()) return;  // another mesh has come
  const Frame& frame = *shown;
  for (const PickedFacts::Row& row : context.widgets.element_under_menu.metrics) {
    if (row.metric == &info(frame.shown)) copy_entry(context, "element quality", short_number(row.now), full_number(row.now));
  }
  const auto corners = frame.input->mesh.elements.corners(element);
  copy_entry(context, "corners", fmt::format("{}", fmt::join(corners, ", ")), fmt::format("{}", fmt::join(corners, " ")));
}

void draw_context_menu(PanelContext& context) {
  if (!ImGui::BeginPopup("viewport menu")) return;
  if (context.widgets.menu_pane < context.panes.size() && !context.state.panes.one()) {
    draw_pane_entries(context, context.panes[context.widgets.menu_pane]);
    ImGui::Separator();
  }
  const auto [vertex, element] = context.widgets.under_menu;
  if (vertex != kNoIndex) draw_vertex_entries(context, vertex);
  if (vertex != kNoIndex && element != kNoIndex) ImGui::Separator();
  if (element != kNoIndex) draw_element_entries(context, element);
  if (vertex != kNoIndex || element != kNoIndex) ImGui::Separator();
  const RunView* run = context.run();
  const bool of_run = context.widgets.menu_pane < context.panes.size() && run != nullptr && run->domain != nullptr &&
                      context.panes[context.widgets.menu_pane].session->input == context.session.input;
  if (of_run && context.frame() != nullptr && (vertex != kNoIndex || element != kNoIndex)) {
    if (draw_kind_entries(context, *context.frame(), *run, vertex, context.widgets.edge_under_menu)) ImGui::Separator();
  }
  for (const char* id : {"smooth-selected", "fix-selected", "step-iteration", "run-pause", "reset", "fit", "inside-clip", "inside-worst",
                         "inside-all", "wireframe", "vertices", "worst-marker", "screenshot"}) {
    const Action& action = *find_action(id);
    if (action.needs == Needs::Selected && !context.situation().selected) continue;
    if (action.needs == Needs::Volume && !context.state.in_space) continue;
    if (action.needs == Needs::Planar && context.state.in_space) continue;
    action_entry(context, id);
  }
  ImGui::EndPopup();
}

/// The edge nearest to the mouse, of the element below it.
EdgeEnds edge_at(const PanelContext& context, const PaneFacts& pane, Index element, Vec2<double> pixel) {
  const Frame& frame = *pane.frame();
  if (frame.input->in_space()) {
    const auto point = context.point_at(pane.number, pixel);
    return point ? nearest_edge(frame, element, *point) : EdgeEnds{kNoIndex, kNoIndex};
  }
  return nearest_edge(frame, element, frame.input->geometry.plane.lift(pane.camera.to_plane(pixel, context.state.viewport)));
}

void open_menu(PanelContext& context, const PaneFacts& pane, Vec2<double> at) {
  WidgetState& widgets = context.widgets;
  widgets.menu_pane = pane.number;
  widgets.under_menu = {kNoIndex, kNoIndex};
  widgets.edge_under_menu = {kNoIndex, kNoIndex};
  if (pane.frame() != nullptr) {
    widgets.under_menu = context.pick(pane.number, at);
    const auto [vertex, element] = widgets.under_menu;
    widgets.vertex_under_menu = facts_of(*pane.frame(), {vertex == kNoIndex ? Picked::Kind::None : Picked::Kind::Vertex, vertex});
    widgets.edge_under_menu = edge_at(context, pane, element, at);
    widgets.element_under_menu = facts_of(*pane.frame(), {element == kNoIndex ? Picked::Kind::None : Picked::Kind::Element, element});
  }
  ImGui::OpenPopup("viewport menu");
}

/// Drags a mesh: one in space turns, or moves with Shift or another button than the left one; a planar one always moves.
void drag_mesh(PanelContext& context, const PaneFacts& pane, Vec2<double> at, Vec2<double> move, bool moves) {
  ViewState& state = context.state;
  if (!pane.in_space()) return state.camera_of(pane.number).pan(move);
  if (moves) {
    state.orbit.pan(move, state.viewport);
  } else if (state.trackball) {
    state.orbit.roll(at - move, at, state.viewport);
  } else {
    state.orbit.turn(move, state.viewport);
  }
}

void zoom_mesh(PanelContext& context, const PaneFacts& pane, Vec2<double> at, double factor) {
  ViewState& state = context.state;
  if (pane.in_space()) return state.orbit.zoom_at(at, state.viewport, factor);
  state.camera_of(pane.number).zoom_at(at, state.viewport, factor);
}

/// Handles a double click: a point of a mesh in space becomes the one that it turns about; everything else shows the whole mesh.
void fit_or_orbit(PanelContext& context, const PaneFacts& pane, Vec2<double> at) {
  if (const auto point = context.point_at(pane.number, at))
    return context.send(fmt::format("orbit-about {} {} {}", point->x, point->y, point->z));
  if (!pane.focus && !context.state.panes.linked && !pane.in_space()) context.send(fmt::format("focus-pane {}", pane.number + 1));
  context.send("fit");
}

void handle_mouse(PanelContext& context, const PaneFacts& pane) {
  const ImGuiIO& io = ImGui::GetIO();
  const Vec2<double> at = mouse_in(pane.rect);
  const bool hovered = ImGui::IsItemHovered();
  bool& dragged = context.widgets.dragged;
  if (hovered && io.MouseWheel != 0) {
    zoom_mesh(context, pane, at, std::pow(1.2, static_cast<double>(io.MouseWheel)));
    context.widgets.moved_at = context.now;
  }
  if (ImGui::IsItemActivated()) dragged = false;
  const bool painting = !pane.in_space() && handle_brush(context, pane, at);
  for (const int button : {ImGuiMouseButton_Left, ImGuiMouseButton_Middle, ImGuiMouseButton_Right}) {
    if (painting && button == ImGuiMouseButton_Left) continue;
    if (!ImGui::IsItemActive() || !ImGui::IsMouseDragging(button, dragged ? 0.0F : context.px(4))) continue;
    // The first drag event carries the way from the press on, so that the grabbed point stays under the cursor.
    const ImVec2 move = dragged ? io.MouseDelta : ImGui::GetMouseDragDelta(button, 0.0F);
    dragged = true;
    drag_mesh(context, pane, at, {static_cast<double>(move.x), static_cast<double>(move.y)},
              button != ImGuiMouseButton_Left || io.KeyShift);
    if (move.x != 0 || move.y != 0) context.widgets.moved_at = context.now;
  }
  if (painting) {
    // A drag is neither a pick nor a fit.
  } else if (hovered && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
    fit_or_orbit(context, pane, at);
  } else if (hovered && ImGui::IsMouseReleased(ImGuiMouseButton_Left) && ImGui::IsItemDeactivated() && !dragged) {
    pick_at(context, pane, at);
  }
  if (hovered && ImGui::IsMouseReleased(ImGuiMouseButton_Right) && !dragged) open_menu(context, pane, at);
}

/// Handles and draws the handle between two viewports that lie over each other.
void handle_split(PanelContext& context) {
  const Rect& rect = context.panes[0].rect;
  const float x = rect.x + context.panes[0].clip.w, reach = context.px(6);
  ImGui::SetCursorScreenPos({x - reach, rect.y});
  ImGui::InvisibleButton("split handle", {2 * reach, rect.h});
  context.items.record_last("split");
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (!ImGui::IsItemActive() || !ImGui::IsMouseDragging(ImGuiMouseButton_Left, 1.0F) || rect.w <= 0) return;
  context.state.panes.split = static_cast<double>(std::clamp((ImGui::GetIO().MousePos.x - rect.x) / rect.w, 0.0F, 1.0F));
}

void draw_split(const PanelContext& context) {
  const Rect& rect = context.panes[0].rect;
  const float x = rect.x + context.panes[0].clip.w, half = context.px(1.5F), middle = rect.y + rect.h / 2;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({x - half, rect.y}, {x + half, rect.y + rect.h}, colour(context.palette.text));
  const float w = context.px(9), h = context.px(20);
  list.AddRectFilled({x - w, middle - h}, {x + w, middle + h}, colour(context.palette.panel), context.px(5));
  list.AddRect({x - w, middle - h}, {x + w, middle + h}, colour(context.palette.text), context.px(5), 0, context.px(1));
  for (const float side : {-1.0F, 1.0F}) {
    const float tip = x + side * context.px(6), base = x + side * context.px(2), up = context.px(5);
    list.AddTriangleFilled({tip, middle}, {base, middle - up}, {base, middle + up}, colour(context.palette.text));
  }
}

/// Draws the picture and handles the viewport's mouse input.
void handle_pane(PanelContext& context, const PaneFacts& pane) {
  const Rect &rect = pane.rect, &clip = pane.clip;
  if (clip.empty()) return;
  const bool one = context.state.panes.one();
  ImGui::PushClipRect({clip.x, clip.y}, {clip.x + clip.w, clip.y + clip.h}, true);
  if (pane.texture != 0 && pane.frame() != nullptr) {
    ImGui::GetWindowDrawList()->AddImage(reinterpret_cast<ImTextureID>(std::uintptr_t{pane.texture}), {rect.x, rect.y},
                                         {rect.x + rect.w, rect.y + rect.h}, {0, 1}, {1, 0});
  }
  ImGui::PushID(static_cast<int>(pane.number));
  if (!one) handle_pane_title(context, pane);
  draw_viewport_tools(context, pane);
  handle_axes(context, pane);
  handle_clip_plane(context, pane);
  ImGui::SetCursorScreenPos({clip.x, clip.y});
  ImGui::InvisibleButton("mesh", {clip.w, clip.h},
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle | ImGuiButtonFlags_MouseButtonRight);
  ImGui::PopID();
  if (pane.focus) context.items.record_last("viewport");
  if (!one) context.items.record_last(fmt::format("viewport:{}", pane.number + 1));
  if (pane.frame() == nullptr) {
    if (ImGui::IsItemHovered() && ImGui::IsMouseReleased(ImGuiMouseButton_Right)) open_menu(context, pane, {});
  } else {
    if (pane.inspected) read_candidate(context, pane);
    if (ImGui::IsItemHovered()) handle_rest(context, pane, mouse_in(pane.rect));
    handle_mouse(context, pane);
  }
  ImGui::PopClipRect();
}

/// Draws everything over the picture.
void draw_pane(PanelContext& context, const PaneFacts& pane) {
  const Rect& clip = pane.clip;
  if (clip.empty()) return;
  ImGui::PushClipRect({clip.x, clip.y}, {clip.x + clip.w, clip.y + clip.h}, true);
  if (pane.frame() != nullptr) draw_labels(context, pane);
  if (pane.frame() != nullptr) draw_pick_label(context, pane);
  if (pane.frame() != nullptr && !pane.current)
    draw_centred(context, clip, fmt::format("drawing {}…", pane.frame()->input->mesh.name), -0.5F);
  if (pane.frame() != nullptr && !pane.in_space()) draw_field_in_view(context, pane);
  draw_clip_plane(context, pane);
  if (pane.frame() != nullptr && pane.inspected) draw_level_label(context, pane);
  draw_note(context, pane, draw_pane_title(context, pane));
  ImGui::PopClipRect();
}

}  // namespace

void draw_viewports(PanelContext& context, const Rect& rect) {
  context.state.inspection.hovered.reset();
  context.state.edge_under_mouse.reset();
  if (rect.empty()) return;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, colour_vector(context.palette.background));
  begin_panel("viewport", rect, false, context.frame() == nullptr);
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
  if (context.frame() == nullptr) {
    const auto reading = context.activity.busy ? being_read(context.activity.command) : std::nullopt;
    if (reading) {
      draw_reading_page(context, rect, *reading);
    } else {
      draw_start_page(context, rect);
    }
    end_panel();
    return;
  }
  const bool split = context.state.panes.layout == PaneLayout::Split;
  handle_colour_bar(context, rect);
  if (split) handle_split(context);
  for (const PaneFacts& pane : context.panes) handle_pane(context, pane);
  if (!std::exchange(context.widgets.pointer_rest.over, false)) context.widgets.pointer_rest = {};
  for (const PaneFacts& pane : context.panes) draw_pane(context, pane);
  if (split) draw_split(context);
  draw_colour_bar(context, rect);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {context.px(8), context.px(8)});
  draw_context_menu(context);
  ImGui::PopStyleVar();
  end_panel();
}

}  // namespace dmoscope::ui
