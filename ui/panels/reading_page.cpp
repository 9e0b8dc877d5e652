#include "ui/panels/reading_page.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ui/panels/widgets.h"

namespace dmoscope::ui {
namespace {

void centred_text(const PanelContext& context, const Rect& rect, const std::string& text, bool dim) {
  const std::string shown = fit_text(text, rect.w - 2 * context.em());
  ImGui::SetCursorPosX(std::max(0.0F, (rect.w - ImGui::CalcTextSize(shown.c_str()).x) / 2));
  if (dim) {
    dim_text(context, shown, false);
  } else {
    ImGui::TextUnformatted(shown.c_str());
  }
}

}  // namespace

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

void draw_preparing(const PanelContext& context, const PaneFacts& pane) {
  const Rect& clip = pane.clip;
  const std::string text = fit_text(fmt::format("drawing {}…", pane.frame()->input->mesh.name), clip.w - 2 * context.em());
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  ImGui::GetWindowDrawList()->AddText({std::round(clip.x + (clip.w - size.x) / 2), std::round(clip.y + (clip.h - size.y) / 2)},
                                      colour(context.palette.dim), text.c_str());
}

}  // namespace dmoscope::ui
