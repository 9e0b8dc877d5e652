#include "core/session/session_standing.h"

#include <algorithm>
#include <utility>

#include "core/session/recompute.h"

namespace dmoscope {

namespace {

void share(RunStanding& standing, const IterationStarts::Positions& positions) {
  standing.start = *positions;
  standing.owner = positions;
}

void own(RunStanding& standing, std::vector<Vec3> positions) {
  share(standing, std::make_shared<const std::vector<Vec3>>(std::move(positions)));
}

}  // namespace

SessionStanding without_runs(const Session& session) {
  SessionStanding standing{{}, {}, session.active_index(), session.shown()};
  for (const auto& input : session.inputs()) standing.meshes.push_back({input, session.source_path(input)});
  return standing;
}

RunStanding without_positions(const Run& run, std::span<const MeshStanding> meshes) {
  const auto mesh = static_cast<std::size_t>(std::ranges::find(meshes, run.shared_input(), &MeshStanding::input) - meshes.begin());
  return {run.parameters(),
          run.moment(),
          run.edits().share(),
          run.history().shared_records(),
          run.size_field(),
          run.given_name(),
          mesh,
          {},
          {},
          run.joint_standing(),
          run.begin()};
}

std::optional<SessionStanding> standing_of(Session& session, const IterationStarts& starts, const std::function<bool()>& go_on) {
  SessionStanding standing = without_runs(session);
  for (std::size_t i = 0; i < session.run_count(); ++i) {
    const Run& run = session.run(i);
    RunStanding one = without_positions(run, standing.meshes);
    const std::uint64_t iteration = run.moment().iteration;
    if (iteration > 0 && run.history().kept(iteration)) {
      const History::Kept& kept = run.history().nearest(iteration);
      one.start = kept.positions;
      one.owner = kept.owner;
    } else if (const auto start = iteration > 0 ? starts.of(run) : nullptr) {
      share(one, start);
    } else if (iteration > 0 && run.moment().is_iteration_end()) {
      const auto now = run.positions();
      own(one, {now.begin(), now.end()});
    } else if (iteration > 0) {
      auto positions = go_on ? positions_at(session, run, iteration, go_on) : std::nullopt;
      if (!positions) return std::nullopt;
      own(one, std::move(*positions));
    }
    standing.runs.push_back(std::move(one));
  }
  return standing;
}

}  // namespace dmoscope
