#include "core/session/command_end.h"

#include <fmt/format.h>

namespace dmoscope {

std::vector<std::string> commands_from(const Run& run, const Moment& before) {
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

}  // namespace dmoscope
