#include "core/session/iteration_starts.h"

#include <algorithm>

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

}  // namespace dmoscope
