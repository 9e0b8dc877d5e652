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

/// A table of the report card's figures: how wide its columns are.
struct FigureTable {
  std::vector<float> widths;
  float width = 0, row = 0, height = 0;
  FigureTable(const std::vector<FigureRow>& rows, float between) : row(ImGui::GetTextLineHeightWithSpacing()) {
    const auto widen = [this](std::size_t column, const std::string& text) {
      if (widths.size() <= column) widths.resize(column + 1);
      widths[column] = std::max(widths[column], ImGui::CalcTextSize(text.c_str()).x);
    };
    for (const FigureRow& each : rows) {
      widen(0, each.name);
      for (std::size_t i = 0; i < each.cells.size(); ++i) widen(i + 1, each.cells[i].text);
    }
    for (float& each : widths) width += each += between;
    height = row * static_cast<float>(rows.size());
  }
};

/// Numbers stand flush right; those that are worse than in the input are marked.
void draw_figures(PanelContext& context, const std::vector<FigureRow>& rows, const FigureTable& table, ImVec2 at) {
  const auto write = [&](const std::string& text, float x, float y, const render::Rgb& ink) {
    ImGui::SetCursorScreenPos({x, y});
    ImGui::PushStyleColor(ImGuiCol_Text, colour_vector(ink));
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
  };
  for (const FigureRow& each : rows) {
    const bool is_now = each.name == "is now";
    write(each.name, at.x, at.y, context.palette.dim);
    float right = at.x + table.widths[0];
    for (std::size_t i = 0; i < each.cells.size(); ++i) {
      right += table.widths[i + 1];
      const bool is_worse = each.cells[i].verdict == Verdict::Worse;
      const auto& ink = is_worse ? context.palette.warning : is_now ? context.palette.text : context.palette.dim;
      write(each.cells[i].text, right - ImGui::CalcTextSize(each.cells[i].text.c_str()).x, at.y, ink);
    }
    at.y += table.row;
  }
}

}  // namespace

void draw_notice(PanelContext& context, const Rect& rect) {
  Notice notice = notice_of(context.session);
  const float em = context.em(), pad = context.px(10), gap = context.px(6), bar = context.px(4);
  if (notice.empty() || notice.key == context.state.dismissed_notice || rect.w < 16 * em || rect.h < 12 * em) return;
  if (rect.h < 28 * em) notice.figures.clear();  // they would hide the mesh; the sentence says what is worse
  const float margin = context.px(8), around = 2 * pad + bar;
  float room = std::min(rect.w - 2 * margin, 34 * em) - around;
  std::vector<std::string> labels;
  for (const Offer& offer : notice.offers) labels.push_back(offer.label);
  const std::string hide = "Hide";
  labels.push_back(hide);
  float wanted = -gap;  // no wider than what is in it
  for (const std::string& label : labels) wanted += button_width(label) + gap;
  for (const std::string& sentence : notice.sentences) wanted = std::max(wanted, ImGui::CalcTextSize(sentence.c_str()).x + 1);
  const FigureTable table(notice.figures, context.px(10));
  room = std::min(room, std::max(wanted, table.width));
  const float width = room + around;
  const ButtonRows rows = in_rows(labels, room, gap);
  float text = 0;
  for (const std::string& line : notice.sentences) text += ImGui::CalcTextSize(line.c_str(), nullptr, false, room).y + gap;
  if (!notice.figures.empty()) text += table.height + gap;
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
  if (!notice.figures.empty()) {
    draw_figures(context, notice.figures, table, {left, y});
    y += table.height + gap;
  }
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
