#include "core/engine/command_end.h"

#include <algorithm>

#include <fmt/format.h>

namespace dmoscope {

namespace {

std::vector<std::string> commands_of(const Run& run, const Moment& before) {
  const Moment& now = run.moment();
  const bool same_place = now.iteration == before.iteration && now.visits == before.visits;
  if (!same_place || now.edits < before.edits) return {fmt::format("seek {} {} {}", now.iteration, now.visits, now.edits)};
  std::vector<std::string> commands;
  for (const Edit& edit : run.edits().all()) {
    if (edit.at < before || edit.at >= now) continue;
    std::string line = "visit";
    for (const Index vertex : edit.vertices) line += fmt::format(" {}", vertex);
    commands.push_back(std::move(line));
  }
  return commands;
}

}  // namespace

std::vector<std::string> commands_from(Session& session, const SessionPoint& before, const std::vector<std::string>& done) {
  if (!session.has_input() || session.input() != before.input) return {};
  std::vector<std::string> commands = done;
  std::size_t selected = before.active;
  const auto select = [&](std::size_t k) {
    if (selected != k) commands.push_back(fmt::format("select-run {}", k + 1));
    selected = k;
  };
  for (std::size_t k = 0; k < session.run_count(); ++k) {
    const Run& run = session.run(k);
    const auto was = std::ranges::find_if(before.runs, [&](const auto& standing) { return standing.run.get() == &run; });
    const Moment from = was == before.runs.end() ? Moment{} : was->point.moment;
    if (run.moment() == from) continue;
    select(k);
    for (std::string& line : commands_of(run, from)) commands.push_back(std::move(line));
  }
  select(session.active_index());
  return commands;
}

}  // namespace dmoscope
