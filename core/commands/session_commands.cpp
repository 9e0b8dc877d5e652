#include "core/commands/session_commands.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/commands/command_rows.h"
#include "core/smooth/execution/method_table.h"

namespace dmoscope {

namespace {

/// Reports the runs' warnings about their backends.
void tell_warnings(CommandContext& context) {
  for (std::size_t i = 0; i < context.session.run_count(); ++i)
    if (std::string warning = context.session.run(i).take_warning(); !warning.empty())
      tell(context, std::move(warning), Message::Kind::Warning);
}

/// Calls `take` with every command, topic by topic.
template <class Take>
void for_command_rows(const Take& take) {
  for (const std::span<const CommandRow> theme : {file_commands(), parameter_commands(), kind_commands(), objective_commands(),
                                                  stepping_commands(), run_commands(), comparison_commands()})
    for (const CommandRow& command : theme) take(command);
}

/// Short text of a command for people: "visit 12 13 14…".
std::string label_of(const std::string& command, Arguments arguments) {
  constexpr std::size_t kLongest = 48;
  std::string label = command;
  for (const std::string& word : arguments) {
    if (label.size() + word.size() > kLongest) return label + " …";
    label += ' ' + word;
  }
  return label;
}

/// Runs `work` and records its changes for undo, even if it fails half-way. `looks_apart`: the shown metric is not changed by it, but
/// perhaps by another command meanwhile.
template <class Work>
void remembering(Session& session, std::string label, bool looks_apart, const Work& work) {
  SessionPoint before = session.point();
  const auto remember = [&] {
    if (looks_apart) before.shown = session.shown();
    session.remember(std::move(label), before);
  };
  try {
    work();
  } catch (...) {
    remember();
    throw;
  }
  remember();
}

/// The range of vertices that "A-B" names, or a single one.
std::pair<std::uint64_t, std::uint64_t> to_range(const std::string& word) {
  const std::size_t dash = word.find('-');
  if (dash == std::string::npos) return {to_count(word), to_count(word)};
  const std::pair range{to_count(word.substr(0, dash)), to_count(word.substr(dash + 1))};
  if (range.first > range.second) throw WrongArguments(fmt::format("'{}' ends before it begins", word));
  return range;
}

}  // namespace

void tell(CommandContext& context, std::string text, Message::Kind kind) { context.say({kind, std::move(text), 0}); }

void tell_interfaces(CommandContext& context) {
  const Run& run = context.session.active();
  if (run.parameters().standing().layers == LayerRule::Keep && !run.input().layers.empty())
    tell(context, run.input().layers_sentence("'layers free'"), Message::Kind::Warning);
  if (run.parameters().interfaces != InterfaceRule::Fixed) return;
  std::string sentence = run.input().interfaces.sentence("'interfaces free'");
  if (!sentence.empty()) tell(context, std::move(sentence), Message::Kind::Warning);
  for (std::string& offer : run.input().interfaces.offers("materials")) tell(context, std::move(offer), Message::Kind::Warning);
}

void change_run(CommandContext& context, const std::function<void(RunParameters&)>& edit) {
  Session& session = context.session;
  RunParameters parameters = session.active().parameters();
  edit(parameters);
  const std::size_t before = session.run_count(), parent = session.active_index();
  std::string from = "the input";
  if (std::exchange(context.continues, false)) {
    const std::uint64_t best = session.continue_with(std::move(parameters), context.progress);
    if (best > 0) from = fmt::format("iteration {} of run {}, its best", best, parent + 1);
  } else {
    session.change(std::move(parameters));
  }
  const Run& now = session.active();
  if (from == "the input" && now.begin()) from = fmt::format("where run {} began", parent + 1);
  if (session.run_count() > before)
    tell(context, fmt::format("started run {}: {}, from {}; the run before is kept", session.active_index() + 1, now.title(), from));
}

RunParameters run_like(RunParameters parameters, const std::string& words) {
  const std::size_t colon = words.find(':');
  parameters.method = method_info(words.substr(0, colon)).name;
  const bool cannot = parameters.combination && !can_combine(method_info(parameters.method), *parameters.combination);
  if (cannot || colon != std::string::npos) parameters.combination.reset();
  if (colon != std::string::npos) parameters.metric = parse_metric(words.substr(colon + 1));
  return parameters;
}

std::vector<Index> to_vertices(Arguments words, const Mesh& mesh) {
  std::vector<Index> vertices;
  for (const std::string& word : words) {
    const auto [first, last] = to_range(word);
    if (last >= mesh.vertex_count()) throw UsageError(fmt::format("there is no vertex {}: the mesh has {}", last, mesh.vertex_count()));
    for (std::uint64_t v = first; v <= last; ++v) vertices.push_back(static_cast<Index>(v));
  }
  return vertices;
}

const std::vector<CommandInfo>& session_commands() {
  static const std::vector<CommandInfo> infos = [] {
    std::vector<CommandInfo> list;
    for_command_rows([&](const CommandRow& command) { list.push_back(command.info); });
    return list;
  }();
  return infos;
}

CommandReach reach_of(std::string_view line) {
  static const std::map<std::string, CommandReach, std::less<>> reaches = [] {
    std::map<std::string, CommandReach, std::less<>> all;
    for_command_rows([&](const CommandRow& command) { all.emplace(command.info.name, command.action.reach); });
    return all;
  }();
  constexpr std::string_view kSpace = " \t";
  line.remove_prefix(std::min(line.find_first_not_of(kSpace), line.size()));
  const auto at = reaches.find(line.substr(0, line.find_first_of(kSpace)));
  return at == reaches.end() ? CommandReach::Session : at->second;
}

void add_session_commands(CommandTable& table, CommandContext& context) {
  for_command_rows([&](const CommandRow& command) {
    table.add(command.info, {command.action.least, command.action.most}, [&context, command](Arguments arguments) {
      const auto& [least, most, handler, remembered, reach] = command.action;
      if (reach == CommandReach::Look) return handler(context, arguments);  // a run may be in the midst of its visits
      const auto carry_out = [&context, &act = handler, arguments] {
        act(context, arguments);
        if (context.session.has_input())
          context.session.active().sync_to_host();  // downloads the results, so that a device that fails later loses none
      };
      if (remembered) {
        remembering(context.session, label_of(command.info.name, arguments), reach == CommandReach::Paths, carry_out);
      } else {
        carry_out();
      }
      tell_warnings(context);
    });
  });
}

}  // namespace dmoscope
