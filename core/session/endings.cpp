#include "core/session/endings.h"

#include <algorithm>
#include <utility>

#include "core/base/error.h"

namespace dmoscope {

namespace {

std::shared_ptr<const RunEnding> ending_of(const Run& run, ThreadPool* pool) {
  return std::make_shared<const RunEnding>(RunEnding{.left = run.last_outcome()->inverted > 0 ? find_left_inverted(run) : std::nullopt,
                                                     .crossing = find_crossing_faces(run),
                                                     .card = report_card(run, pool)});
}

}  // namespace

const Endings::Known* Endings::find_known(Session& session, std::size_t index) const {
  if (!session.run(index).last_outcome()) return nullptr;
  const auto at = std::ranges::find(known_, session.standing(index), &Known::at);
  return at == known_.end() ? nullptr : &*at;
}

std::shared_ptr<const RunEnding> Endings::of(Session& session, std::size_t index) const {
  const Known* known = find_known(session, index);
  return known == nullptr ? nullptr : known->ending;
}

bool Endings::find(Session& session, const std::function<bool()>& go_on) {
  std::vector<Known> all;
  bool found = false;
  for (std::size_t i = 0; i < session.run_count(); ++i) {
    const Run& run = session.run(i);
    if (!run.last_outcome()) continue;
    if (const Known* known = find_known(session, i)) {
      all.push_back(*known);
    } else if (go_on()) {
      all.push_back({session.standing(i), ending_of(run, session.pool().get()), false});
      found = found || all.back().ending;
    }
  }
  known_ = std::move(all);
  return found;
}

bool Endings::find_hint(Session& session, const std::function<bool()>& go_on) {
  if (!session.has_input()) return false;
  const std::size_t active = session.active_index();
  const Known* there = find_known(session, active);
  if (there == nullptr || !there->ending || !there->ending->left || there->tried || !go_on()) return false;
  Known& known = known_[static_cast<std::size_t>(there - known_.data())];
  known.tried = true;
  Progress unwatched;
  UntanglingLook look = untangling_hint(session.run(active), session.pool(), unwatched, go_on);
  known.tried = look.to_the_end;
  if (!look.to_the_end || !look.hint) return false;
  RunEnding with_hint = *known.ending;
  with_hint.hint = std::move(look.hint);
  known.ending = std::make_shared<const RunEnding>(std::move(with_hint));
  return true;
}

}  // namespace dmoscope
