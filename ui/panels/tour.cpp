// The tour's card, and the frame around the control that it points to.
#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "ui/panels/panels.h"

namespace dmoscope::ui {
namespace {

struct Card {
  std::string title, text;
  float width = 0, height = 0, text_height = 0;
};

Card measure(const PanelContext& context, std::string title, std::string text, const Rect& within) {
  const float pad = context.px(12);
  Card card{std::move(title), std::move(text)};
  card.width = std::min(24 * context.em(), within.w - context.px(24));
  card.text_height = ImGui::CalcTextSize(card.text.c_str(), nullptr, false, card.width - 2 * pad).y;
  card.height = 2 * pad + ImGui::GetTextLineHeight() + context.px(6) + card.text_height + context.px(10) + ImGui::GetFrameHeight();
  return card;
}

bool overlaps(const Rect& a, const Items::Box& b) { return a.x < b[2] && b[0] < a.x + a.w && a.y < b[3] && b[1] < a.y + a.h; }

/// Place of the card in a corner of `within` that leaves the control free, the lower right one before others.
Rect place(const PanelContext& context, const Card& card, const Rect& within, const std::optional<Items::Box>& control) {
  const float gap = context.px(18);  // beside the tabs that fold the panels
  const float left = within.x + gap, right = within.x + within.w - gap - card.width;
  const float top = within.y + gap, bottom = within.y + within.h - gap - card.height;
  for (const auto& [x, y] : {std::pair{right, bottom}, {left, bottom}, {right, top}, {left, top}}) {
    const Rect rect{std::round(x), std::round(y), card.width, card.height};
    if (!control || !overlaps(rect, *control)) return rect;
  }
  return {std::round(right), std::round(bottom), card.width, card.height};
}

void begin_card(const PanelContext& context, const Card& card, const Rect& rect) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {context.px(12), context.px(12)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, context.px(6));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, context.px(1.5F));
  ImGui::PushStyleColor(ImGuiCol_WindowBg, colour_vector(context.palette.panel));
  ImGui::PushStyleColor(ImGuiCol_Border, colour_vector(context.palette.accent));
  begin_panel("tour", rect, true);
  ImGui::PopStyleColor(2);
  ImGui::PopStyleVar(3);
  heading(context, card.title.c_str());
  wrapped_text(card.text);
  ImGui::SetCursorPosY(card.height - context.px(12) - ImGui::GetFrameHeight());
}

void card_button(PanelContext& context, const char* item, const char* label, const std::string& command, const char* tooltip,
                 bool primary = false) {
  const bool pressed = button(context, label, primary);
  note_item(context, item, tooltip);
  if (pressed) context.send(command);
}

void draw_control_frame(const PanelContext& context, const Items::Box& box) {
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  const float near = context.px(3), far = context.px(6);
  list.AddRect({box[0] - far, box[1] - far}, {box[2] + far, box[3] + far}, colour(context.palette.accent, 0.35F), context.px(7), 0,
               context.px(4));
  list.AddRect({box[0] - near, box[1] - near}, {box[2] + near, box[3] + near}, colour(context.palette.accent), context.px(5), 0,
               context.px(2));
}

void draw_offer(PanelContext& context, const Rect& within) {
  context.state.tour.offered = true;
  const Card card = measure(context, "New here?",
                            "A tour of two minutes: open a mesh, make a step, look inside it, compare and export. It is in the menu Help, "
                            "too.",
                            within);
  const float x = within.x + (within.w - card.width) / 2, y = within.y + within.h - context.px(12) - card.height;
  begin_card(context, card, {std::round(x), std::round(y), card.width, card.height});
  card_button(context, "tour:take", "Take the tour", "tour on", "", true);
  ImGui::SameLine();
  card_button(context, "tour:off", "No, thanks", "tour off", "");
  end_panel();
}

}  // namespace

void draw_tour(PanelContext& context, const Layout& layout) {
  const Tour& tour = context.state.tour;
  const bool empty = context.session.input == nullptr;
  if (!tour.on && !(tour.offer && empty && !context.activity.busy)) return;
  const Rect& within = layout.viewport;
  if (!tour.on) return draw_offer(context, within);
  const TourStep& step = tour.now();
  std::optional<Items::Box> control;
  for (const std::string_view item : step.items) {
    const auto at = context.items.boxes().find(item);
    if (control || item.empty() || at == context.items.boxes().end()) continue;
    control = at->second;
  }
  const bool other_text = !empty && !step.text_with_mesh.empty();
  const std::size_t steps = tour_steps().size();
  const Card card = measure(context, fmt::format("{} of {}: {}", tour.step + 1, steps, step.title),
                            std::string(other_text ? step.text_with_mesh : step.text), within);
  begin_card(context, card, place(context, card, within, control));
  const bool last = tour.step + 1 == steps;
  ImGui::BeginDisabled(context.activity.busy && !last);
  card_button(context, "tour:next", last ? "Done" : "Next", last ? "tour off" : std::string(step.command),
              last ? "ends the tour" : "does this step for you", true);
  ImGui::EndDisabled();
  if (!last) {
    ImGui::SameLine();
    const char* skip = "Skip the tour";
    ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(skip).x - 2 * ImGui::GetStyle().FramePadding.x);
    card_button(context, "tour:off", skip, "tour off", "it remains in the menu Help");
  }
  end_panel();
  if (control && context.state.dialog == Dialog::None) draw_control_frame(context, *control);
}

}  // namespace dmoscope::ui
