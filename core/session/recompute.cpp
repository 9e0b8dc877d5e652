#include "core/session/recompute.h"

namespace dmoscope {

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
