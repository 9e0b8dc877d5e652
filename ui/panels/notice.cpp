// Over the meshes: the note about a run that has come to its end.
#include "ui/commands/notice.h"

#include <algorithm>
#include <utility>

#include "ui/panels/icons.h"
#include "ui/panels/panels.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

/// Places of buttons that fill rows from the left, and the number of these rows.
struct ButtonRows {
  std::vector<ImVec2> places;  // relative to the upper left corner
  float height = 0;
};
ButtonRows in_rows(const std::vector<std::string>& labels, float room, float gap) {
  ButtonRows rows;
  const float step = ImGui::GetFrameHeight() + gap;
  float x = 0, y = 0;
  for (const std::string& label : labels) {
    const float width = widest_button({label.c_str()});
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

/// Widths of the columns of the report card's figures.
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

/// Draws the figures flush right; those that are worse than in the input are marked.
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

/// Width of the title of the only viewport, which tells of inverted elements.
float title_width(const PanelContext& context) {
  float width = context.px(30);
  for (const PaneFacts& pane : context.panes)
    for (const TitlePiece& piece : title_of(pane, context.session.shown))
      if (piece.role != TitlePiece::Role::Dim) width += ImGui::CalcTextSize(piece.text.c_str()).x + context.px(12);
  return width;
}

/// Place of the note: beside the title of the only viewport if there is room, else below everything that stands under the titles.
Rect place(const PanelContext& context, const Rect& rect, float width, float height) {
  const float em = context.em(), margin = context.px(8);
  const bool beside = context.state.panes.one() && rect.w - width > std::max(16 * em, title_width(context));
  return {rect.x + rect.w - margin - width, rect.y + (beside ? margin : 5.2F * em), width, height};
}

void begin_note(PanelContext& context, const Rect& box) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, context.px(5));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});  // a line is lower than windows usually are
  ImGui::PushStyleColor(ImGuiCol_WindowBg, colour_vector(context.palette.panel, 0.96F));
  begin_panel("notice", box, true);
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(3);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRect({box.x, box.y}, {box.x + box.w, box.y + box.h}, colour(context.palette.line), context.px(5));
  list.AddRectFilled({box.x, box.y}, {box.x + context.px(4), box.y + box.h}, colour(context.palette.warning), context.px(2));
}

/// Draws the first sentence, in a line that unfolds the rest.
void draw_folded(PanelContext& context, const Notice& notice, const Rect& rect) {
  const float pad = context.px(10), bar = context.px(4), icon = context.px(14), height = ImGui::GetFrameHeight();
  const float around = bar + 2 * pad + icon + context.px(6);
  const std::string text = fit_text(notice.sentences.front(), std::min(rect.w - context.px(16) - around, 40 * context.em()));
  const Rect box = place(context, rect, ImGui::CalcTextSize(text.c_str()).x + around, height);
  begin_note(context, box);
  ImGui::SetCursorScreenPos({box.x, box.y});
  if (ImGui::InvisibleButton("##notice", {box.w, height})) context.send("unfold-notice on");
  note_item(context, "notice", notice.sentences.front() + "\n(click: more about it, and what can be done)");
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const render::Rgb ink = context.palette.text;
  list.AddText({box.x + bar + pad, box.y + (height - ImGui::GetTextLineHeight()) / 2}, colour(ink), text.c_str());
  draw_icon(list, Icon::ChevronDown, {box.x + box.w - pad - icon / 2, box.y + height / 2}, icon, colour(context.palette.dim));
  end_panel();
}

void draw_unfolded(PanelContext& context, Notice notice, const Rect& rect) {
  const float em = context.em(), pad = context.px(10), gap = context.px(6), bar = context.px(4);
  if (rect.h < 28 * em) notice.figures.clear();  // they would hide the mesh; the sentence says what is worse
  const float around = 2 * pad + bar;
  float room = std::min(rect.w - context.px(16), 34 * em) - around;
  std::vector<std::string> labels;
  for (const Offer& offer : notice.offers) labels.push_back(offer.label);
  const std::string less = "Less", hide = "Hide";
  labels.push_back(less);
  labels.push_back(hide);
  float wanted = -gap;  // no wider than its contents
  for (const std::string& label : labels) wanted += widest_button({label.c_str()}) + gap;
  for (const std::string& sentence : notice.sentences) wanted = std::max(wanted, ImGui::CalcTextSize(sentence.c_str()).x + 1);
  const FigureTable table(notice.figures, context.px(10));
  room = std::min(room, std::max(wanted, table.width));
  const ButtonRows rows = in_rows(labels, room, gap);
  float text = 0;
  for (const std::string& line : notice.sentences) text += ImGui::CalcTextSize(line.c_str(), nullptr, false, room).y + gap;
  if (!notice.figures.empty()) text += table.height + gap;
  const Rect box = place(context, rect, room + around, text + rows.height + 2 * pad);
  begin_note(context, box);
  const float left = box.x + bar + pad;
  float y = box.y + pad;
  for (const std::string& line : notice.sentences) {
    ImGui::SetCursorScreenPos({left, y});
    ImGui::PushTextWrapPos(bar + pad + room);
    ImGui::TextUnformatted(line.c_str());
    ImGui::PopTextWrapPos();
    y += ImGui::CalcTextSize(line.c_str(), nullptr, false, room).y + gap;
  }
  if (!notice.figures.empty()) {
    draw_figures(context, notice.figures, table, {left, y});
    y += table.height + gap;
  }
  const auto go_to = [&](std::size_t button) { ImGui::SetCursorScreenPos({left + rows.places[button].x, y + rows.places[button].y}); };
  ImGui::BeginDisabled(context.activity.busy);
  for (std::size_t k = 0; k < notice.offers.size(); ++k) {
    const Offer& offer = notice.offers[k];
    go_to(k);
    if (ImGui::Button(offer.label.c_str())) context.send(offer.command);
    note_item(context, offer.id, offer.tooltip);
  }
  ImGui::EndDisabled();
  go_to(labels.size() - 2);
  if (ImGui::Button(less.c_str())) context.send("unfold-notice off");
  note_item(context, "notice-less", "folds it to one line");
  go_to(labels.size() - 1);
  action_button(context, "notice-off", hide.c_str());
  end_panel();
}

}  // namespace

void draw_notice(PanelContext& context, const Rect& rect) {
  Notice notice = notice_of(context.session);
  if (notice.empty() || notice.key == context.state.dismissed_notice) return;
  Rect within = rect;  // viewport of the run, of several
  for (const PaneFacts& pane : context.panes)
    if (pane.focus && !context.state.panes.one()) within = pane.clip;
  if (within.w < 16 * context.em() || within.h < 12 * context.em()) return;
  for (std::string& sentence : notice.sentences) sentence = with_arrows(std::move(sentence));
  if (context.state.panels.notice)
    draw_unfolded(context, std::move(notice), within);
  else
    draw_folded(context, notice, within);
}

}  // namespace dmoscope::ui
