// The timeline: any iteration of the history, played or dragged to, with the marks A and B; below a plot it lies along the plot's axis.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "ui/panels/panels.h"
#include "ui/plots/plot_builder.h"
#include "ui/plots/plot_widget.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

constexpr float kLeastGroove = 8.0F;  // heights of the font

std::string label_of(const PanelContext& context) {
  const RunView* run = context.run();
  if (run == nullptr) return {};
  const std::uint64_t last = context.last_iteration(), now = run->moment.iteration;
  return last == 0 ? "iteration " + count(now) : fmt::format("iteration {} of {}", count(now), count(last));
}

/// Width of the longest label, so that the groove keeps its length.
float label_width(const PanelContext& context) {
  const std::string most = count(std::max<std::uint64_t>(context.last_iteration(), 999));
  return ImGui::CalcTextSize(fmt::format("iteration {0} of {0}", most).c_str()).x;
}

/// Width of everything to the left of the groove.
float buttons_width(const PanelContext& context) {
  const float around = 2 * context.px(7);
  float width = 3 * context.px(4);
  for (const char* label : {"◀", "Play", "▶", "…"}) width += ImGui::CalcTextSize(label).x + around;
  return width;
}

/// Places of the active run's iterations in the groove.
struct Groove {
  Axis axis;                   // maps `x` to pixels
  std::vector<double> course;  // x of every record
  bool by_seconds = false;
  [[nodiscard]] float place(std::uint64_t iteration) const {
    const double x = iteration < course.size() ? course[iteration] : static_cast<double>(iteration);
    return static_cast<float>(std::clamp(axis.place(x), axis.from, axis.to));
  }
};

Groove groove_of(const PanelContext& context, const RunView& run, const TimelineRoom& room) {
  const ViewState& state = context.state;
  const PlotCache* plot = context.widgets.plot.get();
  Groove groove;
  groove.by_seconds = room.below_plot && state.plot_options.by_seconds;
  groove.course = course_of(run, groove.by_seconds);
  if (room.below_plot && plot != nullptr && plot->layout) {
    groove.axis = plot->layout->x;
    return groove;
  }
  const double last = static_cast<double>(std::max<std::uint64_t>(context.last_iteration(), 1));
  groove.axis = {0.0,
                 last,
                 static_cast<double>(room.left),
                 static_cast<double>(room.right),
                 ValueAxis::Linear,
                 state.plot_options.x_axis == XAxis::Log ? 1.0 : 0.0};
  return groove;
}

/// Draws ticks with their letters at the marks of this run.
void draw_marks(const PanelContext& context, const Groove& groove, float top, float bottom) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const Timeline& timeline = context.state.timeline;
  for (const auto& [mark, letter] : {std::pair{&timeline.a, "A"}, {&timeline.b, "B"}}) {
    if (!mark->frame || mark->frame->run != context.session.active) continue;
    const float x = std::round(groove.place(mark->frame->moment.iteration));
    const ImU32 ink = colour(context.palette.text);
    list.AddLine({x, top}, {x, bottom}, ink, context.px(1.5F));
    list.AddText({x + context.px(4), top - context.px(2)}, ink, letter);
  }
}

void draw_groove(const PanelContext& context, const Groove& groove, const TimelineRoom& room, const RunView& run, bool lit) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const float y = std::round((low.y + high.y) / 2), half = context.px(1.5F), knob = groove.place(run.moment.iteration);
  const auto stretch = [&](float from, float to, ImU32 ink) {
    if (to > from) list.AddRectFilled({from, y - half}, {to, y + half}, ink, half);
  };
  stretch(room.left, room.right, colour(context.palette.raised));
  stretch(room.left, groove.place(context.last_iteration()), colour(context.palette.dim, 0.5F));
  stretch(room.left, knob, colour(context.palette.accent));
  draw_marks(context, groove, low.y + context.px(3), high.y - context.px(3));
  list.AddCircleFilled({knob, y}, context.px(lit ? 7 : 6), colour(context.palette.text));
}

void draw_slider(PanelContext& context, const Rect& rect, const TimelineRoom& room) {
  const RunView* run = context.run();
  const float reach = context.px(8);  // room to take the knob at the ends
  ImGui::SetCursorScreenPos({room.left - reach, rect.y});
  ImGui::BeginDisabled(context.last_iteration() == 0 || context.activity.busy);
  ImGui::PushAllowKeyboardFocus(false);  // its keys are those of the buttons
  ImGui::InvisibleButton("##timeline", {room.right - room.left + 2 * reach, rect.h});
  ImGui::PopAllowKeyboardFocus();
  context.items.record("timeline", {room.left, rect.y, room.right, rect.y + rect.h});
  ImGui::EndDisabled();
  if (run == nullptr) return;
  const Groove groove = groove_of(context, *run, room);
  const bool held = ImGui::IsItemActive();
  draw_groove(context, groove, room, *run, held || ImGui::IsItemHovered());
  if (!held) return;
  // While it is held, every new value is a request; the session is asked only when it is idle, so that requests do not pile up.
  const double at = groove.axis.value(static_cast<double>(std::clamp(ImGui::GetIO().MousePos.x, room.left, room.right)));
  const std::uint64_t wanted = iteration_at(*run, groove.by_seconds, at);
  if (wanted != run->moment.iteration && !context.activity.busy) context.send(fmt::format("seek {}", wanted));
}

void draw_more(PanelContext& context) {
  if (ImGui::Button("…")) ImGui::OpenPopup("more of the timeline");
  note_item(context, "timeline-more", "its ends, the best iteration, and marks A and B");
  if (!ImGui::BeginPopup("more of the timeline")) return;
  for (const char* id : {"timeline-first", "timeline-last", "best"}) action_entry(context, id);
  ImGui::Separator();
  for (const char* id : {"mark-a", "mark-b", "flip", "flip-now"}) action_entry(context, id);
  ImGui::EndPopup();
}

void draw_controls(PanelContext& context) {
  const float small = context.px(4);
  action_button(context, "timeline-back", "◀");
  ImGui::SameLine(0, small);
  const Playback& play = context.state.timeline.play;
  action_button(context, "play", play.kind == Playback::Kind::Off ? "Play" : "Stop", false, widest_button({"Play", "Stop"}));
  ImGui::SameLine(0, small);
  action_button(context, "timeline-forward", "▶");
  ImGui::SameLine(0, small);
  draw_more(context);
}

}  // namespace

TimelineRoom timeline_room(const PanelContext& context, const Layout& layout) {
  const float pad = context.px(12), em = context.em(), end = layout.timeline.x + layout.timeline.w - pad;
  TimelineRoom room{layout.timeline.x + pad + buttons_width(context) + context.px(16), end - label_width(context) - context.px(16)};
  room.labelled = room.right - room.left >= kLeastGroove * em;
  if (!room.labelled) room.right = std::max(room.left + em, end - context.px(8));
  const PlotTab tab = context.state.plot;
  const Rect& plots = layout.bottom;
  if (plots.empty() || !over_iterations(tab) || tab == PlotTab::Compare) return room;
  const float left = std::max(room.left, plots.x + pad + 4.2F * em), right = std::min(room.right, plots.x + plots.w - pad - 0.8F * em);
  if (right - left < 0.55F * plots.w) return room;
  return {left, right, room.labelled, true};
}

void draw_timeline(PanelContext& context, const Layout& layout) {
  const Rect& rect = layout.timeline;
  if (rect.empty()) return;
  const float line = ImGui::GetTextLineHeight();
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {context.px(7), std::floor((rect.h - line - context.px(4)) / 2)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {context.px(12), context.px(2)});
  begin_panel("timeline", rect);
  ImGui::PopStyleVar();
  draw_controls(context);
  ImGui::PopStyleVar();
  const TimelineRoom room = timeline_room(context, layout);
  draw_slider(context, rect, room);
  if (room.labelled) {
    const std::string label = label_of(context);
    ImGui::SetCursorScreenPos({rect.x + rect.w - context.px(12) - ImGui::CalcTextSize(label.c_str()).x, rect.y + (rect.h - line) / 2});
    dim_text(context, label, false);
    if (const RunView* run = context.run(); run != nullptr) next_item_tooltip(run->history_note);
  }
  end_panel();
}

}  // namespace dmoscope::ui
