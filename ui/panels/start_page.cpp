// Centre of the window while nothing is loaded, or while a mesh is read or prepared.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ui/panels/panels.h"
#include "ui/panels/widgets.h"

namespace dmoscope::ui {
namespace {

/// Size of a sample's card: side of its square picture, and its width.
struct CardSize {
  float side, width;
};

float card_height(const PanelContext& context, const CardSize& size) { return size.side + ImGui::GetTextLineHeight() + context.px(8); }

void draw_card(PanelContext& context, const Thumbnail& sample, const CardSize& size) {
  const auto [side, width] = size;
  const float pad = std::min(context.px(8), 0.1F * side);
  ImGui::PushID(sample.name.c_str());
  const ImVec2 at = ImGui::GetCursorScreenPos();
  if (ImGui::Button("##card", {width, card_height(context, size)}) && !context.activity.busy) context.send("generate " + sample.name);
  note_item(context, "sample:" + sample.name, sample.doc);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float inner = side - 2 * pad, left = at.x + (width - inner) / 2;
  const ImU32 edge = IM_COL32(0, 0, 0, 110);
  constexpr std::size_t kMostEdged = 800;  // elements; with more the edges would hide the colours
  const bool edges = sample.polygons.size() <= kMostEdged && side > 4.0F * context.em();
  // The soft rim of a filled polygon would stick out of sharp corners, and the edges are soft enough.
  const ImDrawListFlags flags = list.Flags;
  if (edges) list.Flags &= ~ImDrawListFlags_AntiAliasedFill;
  for (const Thumbnail::Polygon& polygon : sample.polygons) {
    ImVec2 corners[4];
    for (int k = 0; k < polygon.count; ++k) {
      const auto& corner = polygon.corners[static_cast<std::size_t>(k)];
      corners[k] = {left + corner[0] * inner, at.y + pad + corner[1] * inner};
    }
    list.AddConvexPolyFilled(corners, polygon.count, colour(polygon.colour));
    // The edges are drawn one by one, because the joints of a polyline stick out of sharp corners.
    for (int k = 0; edges && k < polygon.count; ++k) list.AddLine(corners[k], corners[(k + 1) % polygon.count], edge, 1.0F);
  }
  list.Flags = flags;
  const std::string name = fit_text(sample.name, width);
  list.AddText({at.x + (width - ImGui::CalcTextSize(name.c_str()).x) / 2, at.y + side}, colour(context.palette.text), name.c_str());
  ImGui::PopID();
}

void centred(const Rect& rect, float width) { ImGui::SetCursorPosX(std::max(0.0F, (rect.w - width) / 2)); }

void centred_text(const PanelContext& context, const Rect& rect, const std::string& text, bool dim) {
  const std::string shown = fit_text(text, rect.w - 2 * context.em());
  ImGui::SetCursorPosX(std::max(0.0F, (rect.w - ImGui::CalcTextSize(shown.c_str()).x) / 2));
  if (dim) {
    dim_text(context, shown, false);
  } else {
    ImGui::TextUnformatted(shown.c_str());
  }
}

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
    if (ImGui::Selectable(fit_text(context.shown(file.path), width).c_str(), false, flags, {width, 0}))
      context.send(open_command(file.path));
    context.items.record_last(fmt::format("recent:{}", shown - 1));
    next_item_tooltip(context.shown(file.missing ? file.reason() : file.path));
    ImGui::PopID();
  }
}

}  // namespace

void draw_start_page(PanelContext& context, const Rect& rect) {
  if (context.widgets.thumbnails.empty())
    context.widgets.thumbnails = make_thumbnails(context.state.colour_map, context.widgets.sample_pictures);
  const auto& samples = context.widgets.thumbnails;
  const float em = context.em(), gap = context.px(10);
  // Cards fill one row, or more if there is no room, and are as large as the space allows: a low window gets small pictures.
  float least = 5.5F * em;  // large enough for each name
  for (const Thumbnail& sample : samples) least = std::max(least, ImGui::CalcTextSize(sample.name.c_str()).x + context.px(4));
  const float room = rect.w - 4 * em, most = std::max(1.0F, std::floor((room + gap) / (least + gap)));
  const auto total = static_cast<float>(samples.size());
  const float columns_wanted = total <= most ? total : std::min(most, std::ceil(total / 2.0F));
  const float rows = std::ceil(total / columns_wanted), columns = std::ceil(total / rows);
  const float card = std::clamp((room - (columns - 1) * gap) / columns, 4.5F * em, 8.0F * em);
  const float width = columns * card + (columns - 1) * gap;
  const float header = 9.2F * em, each = (rect.h - header - 1.5F * em) / rows;
  const float below = ImGui::GetTextLineHeight() + context.px(8) + ImGui::GetStyle().ItemSpacing.y;
  const CardSize size{std::clamp(each - below, 1.4F * em, card), card};
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const float recent = context.state.recent_files.empty()
                           ? 0.0F
                           : line * (1.0F + static_cast<float>(std::min<std::size_t>(5, context.state.recent_files.size())));
  const float height = header + rows * (size.side + below) + recent;
  ImGui::SetCursorPosY(std::max(em, (rect.h - height) / 2));

  ImGui::PushFont(context.fonts.large);
  centred_text(context, rect, "dmoscope", false);
  ImGui::PopFont();
  centred_text(context, rect, "Watch a mesh get better: discrete mesh optimization, step by step", true);
  ImGui::Dummy({0, 0.6F * em});

  const std::string open = "Open a mesh…";
  centred(rect, ImGui::CalcTextSize(open.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x);
  action_button(context, "open", open.c_str(), true);
  context.items.record_last("start:open");
  centred_text(context, rect, "or drop a file here, or start from a sample", true);
  ImGui::Dummy({0, 0.6F * em});

  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (k % static_cast<std::size_t>(columns) == 0) {
      centred(rect, width);
    } else {
      ImGui::SameLine(0, gap);
    }
    draw_card(context, samples[k], size);
  }
  draw_recent_files(context, rect, width);
}

void draw_reading_page(PanelContext& context, const Rect& rect, const BeingRead& reading) {
  const Activity& activity = context.activity;
  const float em = context.em(), width = std::min(24 * em, rect.w - 4 * em);
  ImGui::SetCursorPosY(std::max(em, (rect.h - 11 * em) / 2));
  ImGui::PushFont(context.fonts.large);
  centred_text(context, rect, reading.name, false);
  ImGui::PopFont();
  context.items.record_last("reading:name");
  if (!reading.where.empty()) {
    centred_text(context, rect, reading.where, true);
    context.items.record_last("reading:where");
  }
  ImGui::Dummy({0, 0.6F * em});
  ImGui::SetCursorPosX((rect.w - width) / 2);
  ImGui::ProgressBar(static_cast<float>(activity.progress), {width, 0.7F * em}, "");
  context.items.record_last("reading:bar");
  const bool begun = !activity.progress_label.empty() && activity.progress_label != activity.command;
  std::string doing = begun ? fmt::format("{}, {:.0f} %", activity.progress_label, 100.0 * activity.progress) : std::string("opening");
  constexpr double kLong = 2.0;  // seconds after which reading takes long
  if (activity.busy_seconds >= kLong) doing += fmt::format(" · {:.0f} s", activity.busy_seconds);
  centred_text(context, rect, doing, true);
  ImGui::Dummy({0, 0.6F * em});
  const char* cancel = "Cancel";
  ImGui::SetCursorPosX((rect.w - ImGui::CalcTextSize(cancel).x) / 2 - ImGui::GetStyle().FramePadding.x);
  if (ImGui::Button(cancel)) context.send("cancel");
  context.items.record_last("reading:cancel");
}

void draw_centred(const PanelContext& context, const Rect& rect, const std::string& words, float row) {
  const std::string text = fit_text(words, rect.w - context.em());
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  ImGui::GetWindowDrawList()->AddText({std::round(rect.x + (rect.w - size.x) / 2), std::round(rect.y + rect.h / 2 + row * size.y)},
                                      colour(context.palette.dim), text.c_str());
}

}  // namespace dmoscope::ui
