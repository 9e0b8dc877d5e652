// Above the meshes: the note about a run that has come to its end.
#include "ui/commands/notice.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ui/panels/icons.h"
#include "ui/panels/panels.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

/// Draws the report card's figures; those that are worse than in the input are marked.
void draw_figures(PanelContext& context, const std::vector<FigureRow>& rows) {
  const auto columns = static_cast<int>(1 + rows.front().cells.size());
  if (!ImGui::BeginTable("figures", columns, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoHostExtendX)) return;
  for (const FigureRow& row : rows) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    dim_text(context, row.name, false);
    for (const FigureRow::Cell& cell : row.cells) {
      ImGui::TableNextColumn();
      right_text(cell.text, cell.verdict == Verdict::Worse ? context.palette.warning
                            : row.name == "is now"         ? context.palette.text
                                                           : context.palette.dim);
    }
  }
  ImGui::EndTable();
}

/// Draws all that the first line has no room for.
void draw_unfolded(PanelContext& context, const Notice& notice, bool first_was_cut) {
  ImGui::BeginGroup();
  for (const std::string& sentence : notice.sentences)
    if (first_was_cut || &sentence != &notice.sentences.front()) wrapped_text(sentence);
  if (!notice.figures.empty()) draw_figures(context, notice.figures);
  ImGui::BeginDisabled(context.activity.busy);
  for (const Offer& offer : notice.offers) {
    if (&offer != &notice.offers.front()) beside_or_below(offer.label.c_str());
    if (ImGui::Button(offer.label.c_str())) context.send(offer.command);
    note_item(context, offer.id, offer.tooltip);
  }
  ImGui::EndDisabled();
  ImGui::EndGroup();
}

/// Draws the first sentence in a line that unfolds the rest and folds it again, with a cross that takes the note away.
void draw_line(PanelContext& context, const std::string& shown, const std::string& whole, const Rect& box, float left) {
  const float icon = context.px(14), height = ImGui::GetFrameHeight(), cross = box.w - height;
  const bool open = context.state.panels.notice;
  ImGui::SetCursorScreenPos({box.x, box.y});
  if (ImGui::InvisibleButton("##notice", {cross, height})) context.send(open ? "unfold-notice off" : "unfold-notice on");
  note_item(context, "notice", whole + (open ? "\n(click: less)" : "\n(click: more about it, and what can be done)"));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddText({left, box.y + (height - ImGui::GetTextLineHeight()) / 2}, colour(context.palette.text), shown.c_str());
  draw_icon(list, open ? Icon::kChevronUp : Icon::kChevronDown,
            {left + ImGui::CalcTextSize(shown.c_str()).x + icon, std::round(box.y + height / 2)}, icon, colour(context.palette.dim));
  ImGui::SetCursorScreenPos({box.x + cross, box.y + 0.1F * height});
  if (icon_button(context, "notice-off", Icon::kCross, {height, 0.8F * height}, "hides the note")) context.send("notice off");
}

}  // namespace

void draw_notice(PanelContext& context, Layout& layout) {
  Notice notice = notice_of(context.session);
  if (notice.empty() || notice.key == context.state.dismissed_notice) return;
  const float em = context.em(), pad = context.px(12), bar = context.px(4), line = ImGui::GetFrameHeight();
  Rect& mesh = layout.viewport;
  Rect box = layout.uncovered();
  if (box.w < 16 * em || mesh.h < 8 * em) return;
  for (std::string& sentence : notice.sentences) sentence = with_arrows(std::move(sentence));
  if (mesh.h < 28 * em) notice.figures.clear();  // they would leave the mesh no room; the sentence says what is worse
  const bool open = context.state.panels.notice;
  const std::string shown = fit_clauses(notice.sentences.front(), box.w - bar - pad - context.px(28) - line);
  float& height = context.widgets.notice_height;
  box.h = std::round(line + (open ? std::min(height, 0.6F * mesh.h) : 0.0F));
  mesh.y += box.h;
  mesh.h -= box.h;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {pad, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});  // a line is lower than windows usually are
  begin_panel("notice", box, false, open);
  ImGui::PopStyleVar(2);
  draw_line(context, shown, notice.sentences.front(), box, box.x + bar + pad);
  if (open) {
    ImGui::SetCursorScreenPos({box.x + bar + pad, box.y + line - ImGui::GetScrollY()});
    draw_unfolded(context, notice, shown != notice.sentences.front());
    const float now = ImGui::GetItemRectSize().y + context.px(8);
    context.widgets.resized = std::exchange(height, now) != now;
  }
  ImGui::PushClipRect({box.x, box.y}, {box.x + bar, box.y + box.h}, false);
  ImGui::GetWindowDrawList()->AddRectFilled({box.x, box.y}, {box.x + bar, box.y + box.h}, colour(context.palette.warning));
  ImGui::PopClipRect();
  end_panel();
}

}  // namespace dmoscope::ui
