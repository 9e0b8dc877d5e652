// Over the meshes: what a person should know of the run that has come to its end.
#include "ui/commands/notice.h"

#include <algorithm>

#include "ui/panels/panels.h"

namespace dmoscope::ui {
namespace {

float button_width(const std::string& label) { return ImGui::CalcTextSize(label.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x; }

/// Where buttons stand that fill rows from the left, and how many rows that makes.
struct ButtonRows {
  std::vector<ImVec2> places;  // from the upper left corner
  float height = 0;
};
ButtonRows in_rows(const std::vector<std::string>& labels, float room, float gap) {
  ButtonRows rows;
  const float step = ImGui::GetFrameHeight() + gap;
  float x = 0, y = 0;
  for (const std::string& label : labels) {
    const float width = button_width(label);
    if (x > 0 && x + width > room) {
      x = 0;
      y += step;
    }
    rows.places.push_back({x, y});
    x += width + gap;
  }
  rows.height = y + ImGui::GetFrameHeight();
  return rows;
}

}  // namespace

void draw_notice(PanelContext& context, const Rect& rect) {
  const Notice notice = notice_of(context.session);
  const float em = context.em(), pad = context.px(10), gap = context.px(6), bar = context.px(4);
  if (notice.empty() || notice.key == context.state.dismissed_notice || rect.w < 16 * em || rect.h < 12 * em) return;
  const float margin = context.px(8), around = 2 * pad + bar;
  float room = std::min(rect.w - 2 * margin, 31 * em) - around;
  std::vector<std::string> labels;
  for (const Offer& offer : notice.offers) labels.push_back(offer.label);
  const std::string hide = "Hide";
  labels.push_back(hide);
  float wanted = -gap;  // no wider than what is in it
  for (const std::string& label : labels) wanted += button_width(label) + gap;
  for (const std::string& sentence : notice.sentences) wanted = std::max(wanted, ImGui::CalcTextSize(sentence.c_str()).x + 1);
  room = std::min(room, wanted);
  const float width = room + around;
  const ButtonRows rows = in_rows(labels, room, gap);
  float text = 0;
  for (const auto* lines : {&notice.sentences, &notice.figures})
    for (const std::string& line : *lines) text += ImGui::CalcTextSize(line.c_str(), nullptr, false, room).y + gap;
  const float height = text + rows.height + 2 * pad;
  // Beside the title of the one viewport where there is room, else below the titles.
  const bool beside = context.state.panes.one() && rect.w - width > 16 * em;
  const Rect box{rect.x + rect.w - margin - width, rect.y + (beside ? margin : 2.9F * em), width, height};

  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, context.px(5));
  ImGui::PushStyleColor(ImGuiCol_WindowBg, colour_vector(context.palette.panel, 0.96F));
  begin_panel("notice", box, true);
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
  const ImVec2 corner{box.x, box.y};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRect(corner, {corner.x + width, corner.y + height}, colour(context.palette.line), context.px(5));
  list.AddRectFilled(corner, {corner.x + bar, corner.y + height}, colour(context.palette.warning), context.px(2));
  const float left = corner.x + bar + pad;
  float y = corner.y + pad;
  const auto write = [&](const std::string& line) {
    ImGui::SetCursorScreenPos({left, y});
    ImGui::PushTextWrapPos(bar + pad + room);
    ImGui::TextUnformatted(line.c_str());
    ImGui::PopTextWrapPos();
    y += ImGui::CalcTextSize(line.c_str(), nullptr, false, room).y + gap;
  };
  for (const std::string& sentence : notice.sentences) write(sentence);
  ImGui::PushStyleColor(ImGuiCol_Text, colour_vector(context.palette.dim));
  for (const std::string& line : notice.figures) write(line);
  ImGui::PopStyleColor();
  ImGui::BeginDisabled(context.activity.busy);
  for (std::size_t k = 0; k < notice.offers.size(); ++k) {
    const Offer& offer = notice.offers[k];
    ImGui::SetCursorScreenPos({left + rows.places[k].x, y + rows.places[k].y});
    if (ImGui::Button(offer.label.c_str())) context.send(offer.command);
    note_item(context, offer.id, offer.tooltip);
  }
  ImGui::EndDisabled();
  ImGui::SetCursorScreenPos({left + rows.places.back().x, y + rows.places.back().y});
  action_button(context, "notice-off", hide.c_str());
  end_panel();
}

}  // namespace dmoscope::ui
