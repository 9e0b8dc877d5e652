// Status bar, and the strips that stand for folded panels.
#include <algorithm>

#include <fmt/format.h>

#include "ui/panels/panels.h"
#include "ui/state/format.h"
#include "ui/state/run_progress.h"

namespace dmoscope::ui {
namespace {

/// Of the last iteration; of one that goes on the progress says it.
std::string speed_sentence(const PanelContext& context) {
  const RunView* run = context.run();
  if (run == nullptr) return {};
  std::string speed = speed_text(*run);
  for (auto record = run->records.rbegin(); record != run->records.rend(); ++record) {
    if (record->iteration == 0 || record->seconds <= 0.0) continue;
    return speed + (speed.empty() ? "" : " · ") + duration(record->seconds) + "/it";
  }
  return {};
}

/// In line with the text beside it, which ImGui's own bar would put lower.
void draw_bar(const PanelContext& context, float fraction) {
  const ImVec2 at = ImGui::GetCursorScreenPos(), size{8 * context.em(), ImGui::GetTextLineHeight()};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float round = ImGui::GetStyle().FrameRounding;
  list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, ImGui::GetColorU32(ImGuiCol_FrameBg), round);
  const float width = std::clamp(fraction, 0.0F, 1.0F) * size.x;
  if (width >= 1.0F)
    list.AddRectFilled(at, {at.x + width, at.y + size.y}, ImGui::GetColorU32(ImGuiCol_PlotHistogram), std::min(round, width / 2));
  ImGui::Dummy(size);
}

/// Of pictures that are being taken; not in the pictures themselves.
void draw_sequence_progress(PanelContext& context, const Sequence& sequence) {
  if (sequence.phase == Sequence::Phase::Clean) return;
  ImGui::SameLine(0, context.px(16));
  draw_bar(context, static_cast<float>(sequence.progress()));
  ImGui::SameLine();
  ImGui::TextUnformatted(fmt::format("picture {} of {}", sequence.done + 1, sequence.iterations.size()).c_str());
  ImGui::SameLine();
  if (ImGui::SmallButton("Cancel")) context.send("cancel");
  context.items.record_last("cancel");
}

/// Of a run's iterations where they go, of other work how much is done.
std::vector<std::string> progress_said(const PanelContext& context, const RunView* run) {
  const Activity& activity = context.activity;
  if (run != nullptr) return progress_parts(*run, activity.seconds_left);
  const std::string& label = activity.progress_label.empty() ? activity.command : activity.progress_label;
  std::vector<std::string> parts{fmt::format("{} {:.0f} %", fit_text(label, 16 * context.em()), 100.0 * activity.progress)};
  if (activity.seconds_left) parts.push_back(time_left_text(*activity.seconds_left));
  return parts;
}

/// As many of the parts as there is room for, the first at least.
std::string fit_parts(const std::vector<std::string>& parts, float room) {
  std::string text;
  for (const std::string& part : parts) {
    const std::string longer = text.empty() ? part : text + " · " + part;
    if (!text.empty() && ImGui::CalcTextSize(longer.c_str()).x > room) break;
    text = longer;
  }
  return text;
}

/// Shorter work comes and goes before it could be read.
bool shows_work(const PanelContext& context) {
  constexpr double kShowAfter = 0.2;
  return !context.state.sequence && context.activity.busy && context.activity.busy_seconds >= kShowAfter;
}

/// Before all that changes its width meanwhile, so that it stays under the pointer.
void draw_cancel(PanelContext& context) {
  if (!shows_work(context)) return;
  ImGui::SameLine(0, context.px(16));
  if (ImGui::SmallButton("Cancel")) context.send("cancel");
  context.items.record_last("cancel");
}

void draw_progress(PanelContext& context) {
  if (context.state.sequence) return draw_sequence_progress(context, *context.state.sequence);
  if (!shows_work(context)) return;
  ImGui::SameLine(0, context.px(16));
  const auto fraction = static_cast<float>(context.activity.progress);
  const RunView* run = run_at_work(context.session);
  const bool endless = run != nullptr && run->pursuit->until_converged;
  if (!endless) {  // a bar towards the most iterations there may be would say nothing
    draw_bar(context, fraction);
    ImGui::SameLine();
  }
  ImGui::TextUnformatted(fit_parts(progress_said(context, run), ImGui::GetContentRegionAvail().x).c_str());
  context.items.record_last("status-progress");
  next_item_tooltip(fit_parts(progress_said(context, run), 1e9F) + "\n" + context.activity.command);
}

void strip(PanelContext& context, const char* side_name, const Rect& rect, const char* label, const char* tooltip, bool open) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {context.px(4), context.px(6)});
  begin_panel(fmt::format("{} strip", side_name).c_str(), rect);
  ImGui::PopStyleVar();
  const float side = rect.w - 2 * context.px(4);
  if (open) ImGui::PushStyleColor(ImGuiCol_Button, colour_vector(context.palette.accent, 0.25F));
  if (ImGui::Button(label, {side, side})) context.send(fmt::format("unfold {} {}", side_name, open ? "off" : "on"));
  if (open) ImGui::PopStyleColor();
  note_item(context, fmt::format("fold:{}", side_name), tooltip);
  end_panel();
}

}  // namespace

void draw_status(PanelContext& context, const Rect& rect) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {context.px(12), (rect.h - ImGui::GetTextLineHeight()) / 2});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, colour_vector(context.palette.raised));
  begin_panel("status", rect);
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
  const Activity& activity = context.activity;
  const unsigned threads = context.session.threads;
  const bool on_cpu = activity.backend == Backend::Cpu;
  std::string backend = on_cpu ? std::string(name(activity.backend)) : activity.drawing.sentence();
  if (on_cpu && context.session.input) backend += fmt::format(", {} thread{}", threads, threads == 1 ? "" : "s");
  ImGui::TextUnformatted(fit_text(backend, 24 * context.em()).c_str());
  context.items.record_last("status-backend");
  std::string more;
  for (const std::string& line : {activity.backend_reason, on_cpu ? std::string() : activity.drawing.reason, activity.renderer})
    if (!line.empty()) more += (more.empty() ? "" : "\n") + line;
  next_item_tooltip(more);
  draw_cancel(context);
  const bool at_work = activity.busy && run_at_work(context.session) != nullptr;
  if (const std::string speed = speed_sentence(context); !at_work && !speed.empty()) {
    ImGui::SameLine(0, context.px(16));
    dim_text(context, speed, false);
    note_item(context, "status-speed",
              "of the last iteration, smoothing alone: vertices searched a second, those passed over not counted, and its time");
  }
  if (activity.frames_per_second > 0.0) {
    ImGui::SameLine(0, context.px(16));
    dim_text(context, fmt::format("{:.0f} frames/s", activity.frames_per_second), false);
  }
  draw_progress(context);
  const StepNews& news = context.state.stepping.news;
  const bool of_step = !news.sentence.empty() && news.messages == context.state.messages;
  if (const auto& result = context.state.result.newest(); of_step || result) {
    const Message message = of_step ? Message{Message::Kind::Info, news.sentence, 0} : *result;
    std::string text = context.shown(message.text.substr(0, message.text.find('\n')));
    ImGui::SameLine(0, context.px(16));
    const float room = ImGui::GetContentRegionAvail().x;
    if (room > 4 * context.em()) {
      text = fit_text(text, room);
      ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(text.c_str()).x);
      const render::Rgb ink = message.kind == Message::Kind::Error     ? context.palette.error
                              : message.kind == Message::Kind::Warning ? context.palette.warning
                                                                       : context.palette.text;
      ImGui::TextColored(colour_vector(ink), "%s", text.c_str());
      std::string recent = of_step ? news.sentence : std::string();
      for (std::size_t k = context.state.log.size() - std::min<std::size_t>(8, context.state.log.size()); k < context.state.log.size();
           ++k) {
        recent += (recent.empty() ? "" : "\n") + context.state.log[k].text;
      }
      next_item_tooltip(context.shown(recent) + "\n(click shows the log)");
      if (ImGui::IsItemClicked()) context.send("dialog log");
      context.items.record_last("status-message");
    }
  }
  end_panel();
}

void draw_strips(PanelContext& context, const Layout& layout) {
  if (!layout.folded) return;
  const Panels& panels = context.state.panels;
  strip(context, "left", layout.left_strip, "☰", "runs and parameters", panels.left_over);
  strip(context, "right", layout.right_strip, "ℹ", "inspector and worst elements", panels.right_over);
}

}  // namespace dmoscope::ui
