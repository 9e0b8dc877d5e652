// Centre, while nothing is loaded.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ui/panels/panels.h"

namespace dmoscope::ui {
namespace {

void draw_card(PanelContext& context, const Thumbnail& sample, float side) {
  const float line = ImGui::GetTextLineHeight(), pad = context.px(8);
  ImGui::PushID(sample.name.c_str());
  const ImVec2 at = ImGui::GetCursorScreenPos();
  if (ImGui::Button("##card", {side, side + line + pad}) && !context.activity.busy) context.send("generate " + sample.name);
  context.items.record_last("sample:" + sample.name);
  next_item_tooltip(sample.doc);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float inner = side - 2 * pad;
  const ImU32 edge = IM_COL32(0, 0, 0, 110);
  constexpr std::size_t kMostEdged = 800;  // with more elements the edges would hide the colours
  const bool edges = sample.polygons.size() <= kMostEdged;
  for (const Thumbnail::Polygon& polygon : sample.polygons) {
    ImVec2 corners[4];
    for (int k = 0; k < polygon.count; ++k) {
      const auto& corner = polygon.corners[static_cast<std::size_t>(k)];
      corners[k] = {at.x + pad + corner[0] * inner, at.y + pad + corner[1] * inner};
    }
    list.AddConvexPolyFilled(corners, polygon.count, colour(polygon.colour));
    if (edges) list.AddPolyline(corners, polygon.count, edge, ImDrawFlags_Closed, 1.0F);
  }
  const float width = ImGui::CalcTextSize(sample.name.c_str()).x;
  list.AddText({at.x + (side - width) / 2, at.y + side}, colour(context.palette.text), sample.name.c_str());
  ImGui::PopID();
}

void centred(const Rect& rect, float width) { ImGui::SetCursorPosX(std::max(0.0F, (rect.w - width) / 2)); }

void draw_recent_files(PanelContext& context, const Rect& rect, float width) {
  if (context.state.recent_files.empty()) return;
  ImGui::Dummy({0, context.px(6)});
  centred(rect, width);
  dim_text(context, "Recent", false);
  std::size_t shown = 0;
  for (const RecentFile& file : context.widgets.recent.list(context.state.recent_files, context.now)) {
    if (++shown > 5) break;
    centred(rect, width);
    ImGui::PushID(file.path.c_str());
    const ImGuiSelectableFlags flags = file.missing ? ImGuiSelectableFlags_Disabled : 0;
    if (ImGui::Selectable(fit_text(file.path, width).c_str(), false, flags, {width, 0})) context.send(open_command(file.path));
    context.items.record_last(fmt::format("recent:{}", shown - 1));
    next_item_tooltip(file.missing ? file.reason() : file.path);
    ImGui::PopID();
  }
}

}  // namespace

void draw_start_page(PanelContext& context, const Rect& rect) {
  if (context.widgets.thumbnails.empty()) context.widgets.thumbnails = make_thumbnails(context.state.colour_map);
  const auto& samples = context.widgets.thumbnails;
  const float em = context.em(), gap = context.px(10);
  // Cards in one or two rows, as large as the space allows.
  const float room = rect.w - 4 * em;
  const auto total = static_cast<float>(samples.size());
  float columns =
      room > 8 * (5.5F * em + gap) ? total : std::max(1.0F, std::floor(std::min(total / 2.0F + 0.5F, room / (5.5F * em + gap))));
  // A low window gets all cards in one row.
  const bool low = rect.h < 8 * ImGui::GetTextLineHeightWithSpacing() + 2 * 8 * em;
  constexpr float kSmallest = 3.2F;  // em, of a card in such a row
  if (low && total * kSmallest * em + (total - 1) * gap <= room) columns = total;
  const float side = std::clamp((room - (columns - 1) * gap) / columns, (low ? kSmallest : 4.5F) * em, 8.0F * em);
  const float width = columns * side + (columns - 1) * gap;
  const float rows = std::ceil(total / columns);
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const float recent = context.state.recent_files.empty()
                           ? 0.0F
                           : line * (1.0F + static_cast<float>(std::min<std::size_t>(5, context.state.recent_files.size())));
  const float height = 8 * line + rows * (side + 2.4F * em) + recent;
  ImGui::SetCursorPosY(std::max(em, (rect.h - height) / 2));

  ImGui::PushFont(context.fonts.large);
  const char* name = "dmoscope";
  centred(rect, ImGui::CalcTextSize(name).x);
  ImGui::TextUnformatted(name);
  ImGui::PopFont();
  const char* what = "Watch a mesh get better: discrete mesh optimization, step by step";
  const std::string shown = fit_text(what, rect.w - 2 * em);
  centred(rect, ImGui::CalcTextSize(shown.c_str()).x);
  dim_text(context, shown, false);
  ImGui::Dummy({0, 0.6F * em});

  const std::string open = "Open a mesh…";
  centred(rect, ImGui::CalcTextSize(open.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x);
  action_button(context, "open", open.c_str(), true);
  context.items.record_last("start:open");
  const std::string drop = "or drop a file here, or start from a sample";
  centred(rect, ImGui::CalcTextSize(drop.c_str()).x);
  dim_text(context, drop, false);
  ImGui::Dummy({0, 0.6F * em});

  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (k % static_cast<std::size_t>(columns) == 0) {
      centred(rect, width);
    } else {
      ImGui::SameLine(0, gap);
    }
    draw_card(context, samples[k], side);
  }
  draw_recent_files(context, rect, width);
}

}  // namespace dmoscope::ui
