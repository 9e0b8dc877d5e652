#include "ui/state/command_log.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/commands/commands.h"
#include "ui/state/actions.h"

namespace dmoscope::ui {
namespace {

constexpr auto kRecords = std::to_array<std::pair<std::string_view, Record>>({
    {"plot-zoom", Record::Nothing},
    {"scale", Record::Nothing},
    {"click", Record::Nothing},
    {"right-click", Record::Nothing},
    {"double-click", Record::Nothing},
    {"move", Record::Nothing},
    {"drag", Record::Nothing},
    {"right-drag", Record::Nothing},
    {"wheel", Record::Nothing},
    {"key", Record::Nothing},
    {"type", Record::Nothing},
    {"wait", Record::Nothing},
    {"dialog", Record::Nothing},
    {"copy", Record::Nothing},
    {"cancel", Record::Nothing},
    {"run-pause", Record::Shortcut},
    {"timeline", Record::Shortcut},
    {"next-run", Record::Shortcut},
    {"next-metric", Record::Shortcut},
    {"play", Record::ToldOnly},
    {"sequence", Record::ToldOnly},
    {"play-steps", Record::ToldOnly},
    {"watch", Record::ToldOnly},
    {"quit", Record::ToldOnly},
    {"save-script", Record::ToldOnly},
    {"save-session", Record::ToldOnly},
    {"play-levels", Record::Shortcut},
    {"copy-level", Record::Nothing},
    {"place-size-point", Record::Nothing},
    {"notice", Record::Nothing},
    {"ask-unsaved", Record::Nothing},
    {"answer", Record::Nothing},
    {"recovery", Record::Nothing},
    {"begin-rename", Record::Nothing},
    {"tour", Record::Nothing},
});

std::string clock_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  localtime_r(&now, &parts);
  return fmt::format("{:02}:{:02}:{:02}", parts.tm_hour, parts.tm_min, parts.tm_sec);
}

std::string_view command_of(std::string_view line) { return line.substr(0, line.find(' ')); }

/// Puts a text on one line, as comments need, whatever an error says.
std::string one_line(std::string_view text) {
  std::string line(text);
  std::ranges::replace(line, '\n', ' ');
  return line;
}

constexpr std::array kKinds{LogLine::Kind::Info, LogLine::Kind::Warning, LogLine::Kind::Error};  // in the order of Message::Kind
LogLine::Kind kind_of(Message::Kind kind) { return kKinds[static_cast<std::size_t>(kind)]; }

// States of lines, in the order of CommandEnd::Kind.
constexpr std::array kStates{LogLine::State::Done, LogLine::State::Failed, LogLine::State::Cancelled, LogLine::State::Dropped};
constexpr std::array<const char*, 4> kReasons{"", "failed", "cancelled", "cancelled before it began"};
LogLine::State state_of(CommandEnd::Kind kind) { return kStates[static_cast<std::size_t>(kind)]; }
const char* why_not(CommandEnd::Kind kind) { return kReasons[static_cast<std::size_t>(kind)]; }

}  // namespace

Record record_of(std::string_view command) {
  const auto* const at = std::ranges::find(kRecords, command, &std::pair<std::string_view, Record>::first);
  return at == kRecords.end() ? Record::Action : at->second;
}

bool matches(const LogLine& line, std::string_view filter) { return holds_all(line.text, search_words(filter)); }

void CommandLog::show(LogLine line) {
  if (line.text.size() > kLongestText) line.text = line.text.substr(0, kLongestText) + "…";
  if (line.time.empty()) line.time = clock_now();
  lines_.push_back(std::move(line));
  for (; lines_.size() > kMostLines; ++dropped_) lines_.pop_front();
}

void CommandLog::add_step(Step step) {
  if (steps_.size() >= kMostSteps) {
    overflown_ = true;
    return;
  }
  steps_.push_back(std::move(step));
}

LogLine* CommandLog::shown(const Step& step) { return step.shown_as < dropped_ ? nullptr : &lines_[step.shown_as - dropped_]; }

void CommandLog::note_changes(const std::vector<std::string>& look) {
  for (const std::string& line : look) {
    if (std::ranges::find(look_, line) != look_.end()) continue;
    show({LogLine::Kind::Command, line, {}, LogLine::State::Done});
    add_step({line, 0, {}, {}, dropped_ + lines_.size() - 1});
  }
  look_ = look;
}

void CommandLog::begin(std::string_view line, const std::vector<std::string>& look) {
  current_.clear();
  const Record record = record_of(command_of(line));
  noting_ = record != Record::Nothing;
  if (!std::exchange(begun_, true)) first_look_ = look_ = look;
  if (record == Record::Nothing) return;
  note_changes(look);
  if (record == Record::Shortcut) return;
  current_ = line;
  show({LogLine::Kind::Command, std::string(line), {}, LogLine::State::Done});
  add_step({current_, 0, {}, record == Record::ToldOnly ? "not repeated" : "", dropped_ + lines_.size() - 1});
}

void CommandLog::refuse(std::string_view what) {
  if (current_.empty() || steps_.empty()) return;
  steps_.back().why_not = one_line(what);
  if (LogLine* line = shown(steps_.back())) line->state = LogLine::State::Failed;
}

void CommandLog::posted(std::string_view line, std::uint64_t id) {
  const bool of_command = !current_.empty() && !steps_.empty() && !overflown_;
  if (!of_command) {  // sent by a shortcut, or by the window itself
    show({LogLine::Kind::Command, std::string(line), {}, LogLine::State::Pending});
    add_step({std::string(line), id, {}, {}, dropped_ + lines_.size() - 1});
    return;
  }
  steps_.back().id = id;
  if (LogLine* said = shown(steps_.back())) said->state = LogLine::State::Pending;
}

void CommandLog::end(const std::vector<std::string>& look) {
  current_.clear();
  if (noting_) look_ = look;
}

std::string_view CommandLog::line_of(std::uint64_t id) const {
  for (std::size_t k = oldest_pending_; k < steps_.size(); ++k)
    if (steps_[k].id == id && !steps_[k].ended) return steps_[k].line;
  return {};
}

void CommandLog::ended(const CommandEnd& end) {
  const auto from = steps_.begin() + static_cast<std::ptrdiff_t>(oldest_pending_);
  const auto step = std::find_if(from, steps_.end(), [&](const Step& one) { return one.id == end.id; });
  if (step == steps_.end()) return;
  if (LogLine* line = shown(*step)) line->state = state_of(end.kind);
  if (end.kind != CommandEnd::Kind::Done) {
    if (step->why_not.empty()) step->why_not = why_not(end.kind);
    step->resume = end.again;
  }
  step->ended = true;
  const auto pending = [](const Step& one) { return one.id != 0 && !one.ended; };
  while (oldest_pending_ < steps_.size() && !pending(steps_[oldest_pending_])) ++oldest_pending_;
}

void CommandLog::say(const Message& message) { show({kind_of(message.kind), message.text, {}, LogLine::State::Done}); }

std::string CommandLog::script(const std::vector<std::string>& look) const {
  if (overflown_) throw UsageError(fmt::format("this session has more than {} commands: save the session itself instead", kMostSteps));
  std::string text = "# A recorded session: dmoscope script FILE [--headless]\n";
  const auto add = [&text](const std::string& line) { text += line + "\n"; };
  for (const std::string& line : first_look_.empty() ? look : first_look_) add(line);
  for (const Step& step : steps_) {
    const std::string line = one_line(step.line);
    add(step.why_not.empty() ? line : fmt::format("# {}: {}", step.why_not, line));
    std::ranges::for_each(step.resume, add);
  }
  for (const std::string& line : look) {
    if (begun_ && std::ranges::find(look_, line) == look_.end()) add(line);
  }
  return text;
}

}  // namespace dmoscope::ui
