// Status bar.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ui/analysis/step_report.h"
#include "ui/commands/notice.h"
#include "ui/panels/panels.h"
#include "ui/state/format.h"
#include "ui/state/run_progress.h"

namespace dmoscope::ui {
namespace {

/// Speed of the last iteration; the progress tells that of the one at work.
std::string speed_sentence(const PanelContext& context) {
  const RunView* run = context.run();
  if (run == nullptr) return {};
  std::string speed = speed_text(*run);
  for (auto record = run->records.rbegin(); record != run->records.rend(); ++record) {
    if (record->iteration == 0 || record->seconds <= 0.0) continue;
    return speed + (speed.empty() ? "" : " · ") + duration(record->seconds) + " per iteration";
  }
  return {};
}

/// Draws a progress bar in line with the text beside it.
void draw_bar(const PanelContext& context, float fraction) {
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0, 0});
  ImGui::ProgressBar(fraction, {std::min(8 * context.em(), 0.25F * ImGui::GetWindowWidth()), ImGui::GetTextLineHeight()}, "");
  ImGui::PopStyleVar();
}

/// Draws Cancel before everything that changes its width meanwhile, so that it stays under the pointer.
void draw_cancel(PanelContext& context) {
  if (ImGui::SmallButton("Cancel")) context.send("cancel");
  context.items.record_last("cancel");
}

/// Draws the progress of pictures that are being taken; not in the pictures themselves.
void draw_sequence_progress(PanelContext& context, const Sequence& sequence) {
  if (sequence.phase == Sequence::Phase::Clean) return;
  draw_bar(context, static_cast<float>(sequence.progress()));
  ImGui::SameLine();
  ImGui::TextUnformatted(fmt::format("picture {} of {}", sequence.done + 1, sequence.iterations.size()).c_str());
  ImGui::SameLine();
  draw_cancel(context);
}

/// Texts of a run's progress, or for other work how much is done.
std::vector<std::string> progress_said(const PanelContext& context, const RunView* run) {
  const Activity& activity = context.activity;
  if (run != nullptr) return progress_parts(*run, activity.seconds_left);
  const std::string& label = activity.progress_label.empty() ? activity.command : activity.progress_label;
  std::vector<std::string> parts{fmt::format("{} {:.0f} %", fit_text(label, 16 * context.em()), 100.0 * activity.progress)};
  if (activity.seconds_left) parts.push_back(time_left_text(*activity.seconds_left));
  return parts;
}

/// The first parts that there is room for, at least one.
std::string fit_parts(const std::vector<std::string>& parts, float room) {
  std::string text;
  for (const std::string& part : parts) {
    const std::string longer = text.empty() ? part : text + " · " + part;
    if (!text.empty() && ImGui::CalcTextSize(longer.c_str()).x > room) break;
    text = longer;
  }
  return text;
}

/// Whether work has taken long enough to be shown: shorter work would disappear before it could be read.
bool shows_work(const PanelContext& context) {
  constexpr double kShowAfter = 0.2;
  return !context.state.sequence && context.activity.busy && context.activity.busy_seconds >= kShowAfter;
}

void draw_progress(PanelContext& context) {
  if (context.state.sequence) return draw_sequence_progress(context, *context.state.sequence);
  draw_cancel(context);
  ImGui::SameLine(0, context.px(10));
  const auto fraction = static_cast<float>(context.activity.progress);
  const RunView* run = run_at_work(context.session);
  const bool endless = run != nullptr && run->pursuit->until_converged;
  if (!endless) {  // a bar towards the greatest possible number of iterations would say nothing
    draw_bar(context, fraction);
    ImGui::SameLine();
  }
  ImGui::TextUnformatted(fit_parts(progress_said(context, run), ImGui::GetContentRegionAvail().x).c_str());
  context.items.record_last("status-progress");
  next_item_tooltip(fit_parts(progress_said(context, run), 1e9F) + "\n" + context.activity.command);
}

/// The newest message, or the sentence of a step.
std::optional<Message> newest_message(const PanelContext& context) {
  const StepNews& news = context.state.stepping.news;
  if (!news.sentence.empty() && news.messages == context.state.messages) return Message{Message::Kind::Info, news.sentence, 0};
  return context.state.result.newest();
}

std::string first_line(const PanelContext& context, const Message& message) {
  return context.shown(with_arrows(message.text.substr(0, message.text.find('\n'))));
}

render::Rgb ink_of(const PanelContext& context, const Message& message) {
  return message.kind == Message::Kind::Error     ? context.palette.error
         : message.kind == Message::Kind::Warning ? context.palette.warning
                                                  : context.palette.text;
}

/// Whether a message must be read whole: a warning, an error, or a step within an iteration. The facts tell everything else that counts,
/// and a warning that the note of the run's end repeats stands there.
bool is_urgent(const PanelContext& context, const Message& message) {
  const RunView* run = context.run();
  if (message.kind == Message::Kind::Info)
    return run != nullptr && run->moment.visits > 0 && message.text == context.state.stepping.news.sentence && !context.state.tour.on;
  const Notice notice = notice_of(context.session);
  return std::ranges::none_of(notice.sentences, [&](const std::string& sentence) {
    return notice.key != context.state.dismissed_notice &&
           message.text.starts_with(std::string_view(sentence).substr(0, sentence.size() - 1));
  });
}

/// Draws the newest message. `room`: up to the right end's texts.
void draw_newest(PanelContext& context, float room) {
  const auto message = newest_message(context);
  if (!message || room < 3 * context.em()) return;
  const std::string text = first_line(context, *message);
  ImGui::TextColored(colour_vector(ink_of(context, *message)), "%s", fit_clauses(text, room + 1).c_str());
  std::string recent = message->text;
  const std::deque<Message>& log = context.state.log;
  for (std::size_t k = log.size() - std::min<std::size_t>(8, log.size()); k < log.size(); ++k)
    if (log[k].text != message->text) recent += "\n" + log[k].text;
  const std::string speed = speed_sentence(context);
  next_item_tooltip(context.shown(recent) + (speed.empty() ? "" : "\n" + speed) + "\n(click shows the log)");
  if (ImGui::IsItemClicked()) context.send("dialog log");
  context.items.record_last("status-message");
}

/// Draws "2 CPU threads", or the way from a device to the screen; the speed stands in the tooltip.
void draw_backend(PanelContext& context, const std::string& backend) {
  const Activity& activity = context.activity;
  dim_text(context, backend, false);
  context.items.record_last("status-backend");
  std::string more;
  for (const std::string& line : {activity.backend_reason, activity.backend == Backend::Cpu ? std::string() : activity.drawing.reason,
                                  activity.renderer, speed_sentence(context)})
    if (!line.empty()) more += (more.empty() ? "" : "\n") + line;
  next_item_tooltip(more);
}

std::string backend_words(const PanelContext& context) {
  const Activity& activity = context.activity;
  const unsigned threads = context.session.threads;
  if (activity.frames_per_second > 0.0 && !activity.busy) return fmt::format("{:.0f} frames/s", activity.frames_per_second);
  if (activity.backend != Backend::Cpu) return activity.drawing.sentence();
  return context.session.input ? fmt::format("{} CPU thread{}", threads, threads == 1 ? "" : "s") : std::string("CPU");
}

}  // namespace

void give_message_room(PanelContext& context, Layout& layout) {
  const auto message = newest_message(context);
  if (!message || context.state.sequence || shows_work(context) || !is_urgent(context, *message)) return;
  Rect& status = layout.status;
  const float end = status.x + status.w, width = ImGui::CalcTextSize(first_line(context, *message).c_str()).x + 1;
  status.w = std::clamp(std::ceil(width + 2 * context.px(12)), status.w, end);
  status.x = end - status.w;
}

void draw_status(PanelContext& context, const Layout& layout) {
  const Rect& rect = layout.status;
  const bool over_timeline = rect.x < layout.timeline.x + layout.timeline.w;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {context.px(12), (rect.h - ImGui::GetTextLineHeight()) / 2});
  begin_panel(over_timeline ? "message" : "status", rect, over_timeline);
  ImGui::PopStyleVar();
  const bool at_work = context.state.sequence || shows_work(context);
  const std::string backend = fit_text(backend_words(context), 0.6F * rect.w);
  const float end = rect.w - context.px(12) - ImGui::CalcTextSize(backend.c_str()).x;
  if (at_work) {
    draw_progress(context);
  } else {
    const auto message = newest_message(context);
    const float whole = message ? ImGui::CalcTextSize(first_line(context, *message).c_str()).x : 0.0F;
    const bool both = context.px(24) + whole <= end;  // otherwise the message needs all the room
    draw_newest(context, both ? whole : rect.w - context.px(24));
    if (both) {
      ImGui::SameLine(end);
      draw_backend(context, backend);
    }
  }
  end_panel();
}

}  // namespace dmoscope::ui
