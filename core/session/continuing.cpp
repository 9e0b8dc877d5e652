// Changed parameters for a run: a new run from the same start, or from the best state reached.

#include <cstring>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/reference/domain.h"
#include "core/run/ending.h"
#include "core/session/session.h"
#include "core/session/session_standing.h"

namespace dmoscope {

namespace {

bool is_untouched(const Run& run) { return run.moment() == Moment{} && run.history().records().size() == 1 && run.edits().all().empty(); }

/// Rank of a vertex's freedom: none, along a curve, on a surface, anywhere.
int freedom(const Run& run, Index vertex) {
  if (run.fixed()[vertex] != 0) return 0;
  if (!run.domain() || !run.domain()->slides(vertex)) return 3;
  return run.domain()->on_curve(vertex) ? 1 : 2;
}

/// Throws if a moved vertex would have less freedom: its place under the old rules need not be possible under stricter ones.
void require_no_stricter(const Run& before, const Run& after, const BeginPositions& begin) {
  if (!begin) return;
  const std::vector<Vec3>& places = before.input().mesh.positions;
  Index stricter = 0;
  for (Index v = 0; v < places.size(); ++v)
    if (freedom(after, v) < freedom(before, v) && std::memcmp(&(*begin)[v], &places[v], sizeof(Vec3)) != 0) ++stricter;
  if (stricter > 0)
    throw UsageError(fmt::format("{} would be held more firmly than before, and has moved: that cannot begin but from the input",
                                 stricter == 1 ? "a vertex" : fmt::format("each of {} vertices", stricter)));
}

}  // namespace

/// Puts a run in the place of the active one if that has not moved, else beside it.
std::size_t Session::put(std::shared_ptr<Run> run) {
  const Run& current = active();
  if (!is_untouched(current)) return add(std::move(run));
  run->set_id(current.id());
  run->set_given_name(current.given_name());
  runs_[active_] = std::move(run);
  share_history();
  return active_;
}

std::size_t Session::change(RunParameters parameters) {
  const Run& current = active();
  if (!current.begin()) return put(make_run(input_, std::move(parameters)));
  try {
    auto run = make_run(input_, parameters, current.begin());
    require_no_stricter(current, *run, current.begin());
    return put(std::move(run));
  } catch (const UsageError&) {  // also for invalid parameters, which the input refuses as well
    return put(make_run(input_, std::move(parameters)));
  }
}

std::uint64_t Session::continue_with(RunParameters parameters, Progress& progress) {
  Run& current = active();
  const std::uint64_t best = best_iteration(current);
  BeginPositions begin = current.begin();
  if (best > 0) {
    const auto go_on = [&progress] {
      progress.check();
      return true;
    };
    const bool here = current.moment() == Moment{best};
    const auto now = here ? current.positions() : std::span<const Vec3>();
    begin = std::make_shared<const std::vector<Vec3>>(here ? std::vector<Vec3>(now.begin(), now.end())
                                                           : positions_at(*this, current, best, go_on).value());
  }
  std::shared_ptr<Run> next;
  try {
    next = make_run(input_, parameters, begin);
  } catch (const UsageError&) {
    (void)make_run(input_, std::move(parameters));  // throws if the parameters themselves are invalid
    throw UsageError("what would be fixed has moved: that cannot begin but from the input");
  }
  require_no_stricter(current, *next, begin);
  put(std::move(next));
  return best;
}

}  // namespace dmoscope
