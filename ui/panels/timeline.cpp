// The timeline: any iteration of the history, played or scrubbed, with the marks A and B.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ui/panels/panels.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

/// Ticks with their letters where the marks of this run lie on the slider drawn last.
void draw_marks(const PanelContext& context, float last) {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const float inset = 2.0F + ImGui::GetStyle().GrabMinSize / 2;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const Timeline& timeline = context.state.timeline;
  for (const auto& [mark, letter] : {std::pair{&timeline.a, "A"}, {&timeline.b, "B"}}) {
    if (!mark->frame || mark->frame->run != context.session.active) continue;
    const float t = std::min(1.0F, static_cast<float>(mark->frame->moment.iteration) / std::max(1.0F, last));
    const float x = std::round(low.x + inset + t * (high.x - low.x - 2 * inset));
    const ImU32 ink = colour(context.palette.text);
    list.AddLine({x, low.y}, {x, high.y}, ink, context.px(1.5F));
    const float width = ImGui::CalcTextSize(letter).x;
    const bool left = x + context.px(4) + width > high.x;
    list.AddText({left ? x - context.px(4) - width : x + context.px(4), (low.y + high.y - ImGui::GetTextLineHeight()) / 2}, ink, letter);
  }
}

std::string label_of(const PanelContext& context, std::uint64_t last) {
  const RunView* run = context.run();
  if (run == nullptr) return {};
  return fmt::format("iteration {} of {}", count(run->moment.iteration), count(last));
}

void draw_slider(PanelContext& context, std::uint64_t last, float width) {
  const RunView* run = context.run();
  ImGui::SetNextItemWidth(width);
  const bool possible = last > 0 && !context.activity.busy;
  ImGui::BeginDisabled(!possible);
  // A slider of real numbers: its grab stays small however short the history is.
  float position = run == nullptr ? 0.0F : static_cast<float>(run->moment.iteration);
  ImGui::PushAllowKeyboardFocus(false);  // Tab, which has a meaning of its own, would make a text field of it
  ImGui::SliderFloat("##timeline", &position, 0.0F, std::max(1.0F, static_cast<float>(last)), "", ImGuiSliderFlags_AlwaysClamp);
  ImGui::PopAllowKeyboardFocus();
  const auto at = static_cast<std::uint64_t>(std::llround(position));
  context.items.record_last("timeline");
  draw_marks(context, static_cast<float>(last));
  // While the slider is held every new value is a request; the session is asked only when it is idle, so they do not pile up.
  if (run != nullptr && possible && ImGui::IsItemActive() && at != run->moment.iteration) context.send(fmt::format("seek {}", at));
  ImGui::EndDisabled();
}

void draw_controls(PanelContext& context) {
  const RunView* run = context.run();
  const std::uint64_t last = run == nullptr || run->records.empty() ? 0 : run->records.back().iteration;
  const float small = context.px(4);
  action_button(context, "timeline-first", "|◀");
  ImGui::SameLine(0, small);
  action_button(context, "timeline-back", "◀");
  ImGui::SameLine(0, small);
  const Playback& play = context.state.timeline.play;
  action_button(context, "play", play.kind == Playback::Kind::Off ? "Play" : "Stop", false, widest_button({"Play", "Stop"}));
  ImGui::SameLine(0, small);
  action_button(context, "timeline-forward", "▶");
  ImGui::SameLine(0, small);
  action_button(context, "timeline-last", "▶|");
  ImGui::SameLine(0, small);
  action_button(context, "best", "Best");
  ImGui::SameLine();
  const std::string label = label_of(context, last);
  const float label_width = ImGui::CalcTextSize(fmt::format("iteration {0} of {0}", count(std::max<std::uint64_t>(last, 999))).c_str()).x;
  const float padding = 2 * ImGui::GetStyle().FramePadding.x;
  const float buttons = 3 * padding + ImGui::CalcTextSize("ABFlip").x + 2 * small + context.px(16);
  const float room = ImGui::GetContentRegionAvail().x;
  // Narrow windows keep the slider; marks and flipping have their keys.
  const bool wide = room > label_width + buttons + 14 * context.em();
  draw_slider(context, last, std::max(4 * context.em(), room - label_width - (wide ? buttons : 0.0F) - context.px(12)));
  if (wide) {
    ImGui::SameLine();
    action_button(context, "mark-a", "A");
    ImGui::SameLine(0, small);
    action_button(context, "mark-b", "B");
    ImGui::SameLine(0, small);
    action_button(context, "flip", "Flip");
  }
  ImGui::SameLine();
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(label.c_str()).x);
  ImGui::AlignTextToFramePadding();
  dim_text(context, label, false);
  if (run != nullptr && !run->history_note.empty()) next_item_tooltip(run->history_note);
}

}  // namespace

void draw_timeline(PanelContext& context, const Rect& rect) {
  if (rect.empty()) return;
  const float line = ImGui::GetTextLineHeight();
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {context.px(7), std::floor((rect.h - line - context.px(4)) / 2)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {context.px(12), context.px(2)});
  begin_panel("timeline", rect);
  ImGui::PopStyleVar();
  draw_controls(context);
  ImGui::PopStyleVar();
  end_panel();
}

}  // namespace dmoscope::ui
