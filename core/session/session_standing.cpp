#include "core/session/session_standing.h"

#include <algorithm>
#include <utility>

namespace dmoscope {

bool IterationStarts::Start::is_of(const Run& other) const {
  if (run.lock().get() != &other || other.moment().iteration != iteration || other.backend() != backend) return false;
  const std::vector<Edit>& all = other.edits().all();
  const std::size_t done = other.edits().done_by({iteration});
  return done == edits.size() && std::equal(edits.begin(), edits.end(), all.begin());
}

IterationStarts::Positions IterationStarts::of(const Run& run) const {
  const auto start = std::ranges::find_if(starts_, [&](const Start& one) { return one.is_of(run); });
  return start != starts_.end() ? start->positions : nullptr;
}

void IterationStarts::note(const std::weak_ptr<const Run>& identity) {
  std::erase_if(starts_, [](const Start& start) {
    const auto run = start.run.lock();
    return !run || !start.is_of(*run) || run->history().kept(start.iteration);
  });
  const auto run = identity.lock();
  if (!run || !run->moment().is_iteration_end() || run->history().kept(run->moment().iteration) || of(*run)) return;
  const auto positions = run->positions();
  const auto& edits = run->edits().all();
  const auto done = static_cast<std::ptrdiff_t>(run->edits().done_by(run->moment()));
  starts_.push_back({identity,
                     run->moment().iteration,
                     run->backend(),
                     {edits.begin(), edits.begin() + done},
                     std::make_shared<const std::vector<Vec3>>(positions.begin(), positions.end())});
}

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

std::optional<std::vector<Vec3>> positions_at(const Session& session, const Run& run, std::uint64_t iteration,
                                              const std::function<bool()>& go_on) {
  const History::Kept& kept = run.history().nearest(iteration);
  if (kept.iteration == iteration) return std::vector<Vec3>(kept.positions.begin(), kept.positions.end());
  RunParameters parameters = run.parameters();
  if (run.backend() == Backend::Cpu) parameters.backend = Backend::Cpu;  // also after a device failed
  const auto other = session.make_run(run.shared_input(), std::move(parameters), run.begin());
  other->set_history_budget(0);
  Progress progress;
  const auto watch = [&](const Run&) {
    if (!go_on()) progress.request_cancel();
  };
  other->set_observer(watch);
  RunSnapshot start = run.point();
  start.moment = {kept.iteration};
  try {
    watch(*other);
    other->adopt(start, kept.positions, progress);
    other->seek({iteration}, progress);
  } catch (const Cancelled&) {
    return std::nullopt;
  }
  const auto positions = other->positions();
  return std::vector<Vec3>(positions.begin(), positions.end());
}

}  // namespace dmoscope
