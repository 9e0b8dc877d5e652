#include "ui/state/result_line.h"

#include <utility>

#include <fmt/format.h>

#include "ui/state/format.h"

namespace dmoscope::ui {

void ResultLine::say(const Message& message) {
  newest_ = message;
  said_ = true;
}

void ResultLine::ended(std::string_view line, const CommandEnd& end) {
  const bool own_words = std::exchange(said_, false);
  if (own_words || line.empty() || end.kind != CommandEnd::Kind::Done) return;
  std::string text = fmt::format("{}: ", line);
  if (end.moved) {
    text += "now at iteration " + count(end.at.iteration);
    if (end.at.visits > 0) text += fmt::format(" and {}", counted(end.at.visits, "visit", "visits"));
  } else {
    text += "done";
  }
  newest_ = Message{Message::Kind::Info, std::move(text), 0};
}

void ResultLine::succeeded() {
  if (newest_ && newest_->kind == Message::Kind::Error) newest_.reset();
}

}  // namespace dmoscope::ui
