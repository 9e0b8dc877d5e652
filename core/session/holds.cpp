#include "core/session/holds.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/stopwatch.h"
#include "core/run/ending.h"
#include "core/session/session.h"

namespace dmoscope {

namespace {

constexpr Index kSmall = 300'000;            // elements, for which a domain takes some 0.3 s at most
constexpr std::size_t kMostHoldDomains = 3;  // number of domains that are kept: the next moment asks for the same ones

}  // namespace

const Holds::Known* Holds::find_known(Session& session, std::size_t index) const {
  const auto at = std::ranges::find(known_, session.standing(index), &Known::at);
  return at == known_.end() ? nullptr : &*at;
}

Holds::Latest Holds::of(Session& session, std::size_t index) const {
  const StandingRun now = session.standing(index);
  const auto at = std::ranges::find_if(known_, [&](const Known& known) { return known.at.is_of(now); });
  return at == known_.end() ? Latest{} : Latest{at->found, at->at == now};
}

std::shared_ptr<const Domain> Holds::domain(const std::shared_ptr<const InputMesh>& input, const StandingRule& rule) {
  std::erase_if(domains_, [](const KnownDomain& one) { return one.input.expired(); });
  const auto known = std::ranges::find_if(domains_, [&](const KnownDomain& one) { return one.input.lock() == input && one.rule == rule; });
  if (known != domains_.end()) return known->domain;
  auto made = domain_for(*input, rule);
  if (domains_.size() >= kMostHoldDomains) domains_.erase(domains_.begin());
  domains_.push_back({input, rule, made});
  return made;
}

std::shared_ptr<const HeldMinimum> Holds::find(Session& session, std::size_t index, Progress& progress,
                                               const std::function<bool()>& go_on) {
  const bool asked = !go_on;
  if (const Known* known = find_known(session, index)) {
    if (asked && !known->tried) try_known(session, index, {}, session.pool(), progress);
    return find_known(session, index)->found;
  }
  const Run& run = session.run(index);
  const auto domains = [&](const StandingRule& rule) { return domain(run.shared_input(), rule); };
  auto found = what_holds(run, session.pool().get(), progress, {domains, go_on, !asked});
  if (found && !found->untried.empty()) throw Cancelled();
  const StandingRun here = session.standing(index);
  std::erase_if(known_, [&](const Known& known) { return known.at.run.expired() || known.at.is_of(here); });
  known_.push_back({here, found ? std::make_shared<const HeldMinimum>(std::move(*found)) : nullptr});
  if (asked) try_known(session, index, {}, session.pool(), progress);
  return find_known(session, index)->found;
}

/// Tries the switch found; does nothing if the positions of the best iteration are lost.
void Holds::try_known(Session& session, std::size_t index, const TrialBudget& budget, const std::shared_ptr<ThreadPool>& pool,
                      Progress& progress) {
  Known& known = known_[static_cast<std::size_t>(find_known(session, index) - known_.data())];
  known.tried = true;
  if (!known.found || !known.found->change) return;
  const Run& run = session.run(index);
  const std::uint64_t best = best_iteration(run);
  TrialBegin begin;
  if (run.moment() != Moment{best}) begin.from = best;
  if (best > 0) {
    if (begin.from && !run.history().kept(best)) return;
    const auto there = begin.from ? run.history().nearest(best).positions : run.positions();
    begin.positions = std::make_shared<const std::vector<Vec3>>(there.begin(), there.end());
  }
  auto trial = try_switch(run, *known.found, begin, budget, pool, progress);
  if (!trial) return;
  HeldMinimum with_trial = *known.found;
  with_trial.trial = trial;
  known.found = std::make_shared<const HeldMinimum>(std::move(with_trial));
}

bool Holds::find_at_rest(Session& session, const std::function<bool()>& go_on) {
  if (!session.has_input() || session.input()->mesh.elements.size() > kSmall) return false;
  if (find_known(session, session.active_index()) != nullptr || !go_on()) return false;
  Progress unwatched;
  try {
    return find(session, session.active_index(), unwatched, go_on) != nullptr;
  } catch (const Cancelled&) {
    return false;
  }
}

bool Holds::try_at_rest(Session& session, const std::function<bool()>& go_on) {
  if (!session.has_input()) return false;
  const std::size_t active = session.active_index();
  const Known* known = find_known(session, active);
  if (known == nullptr || known->tried || !go_on()) return false;
  constexpr double kSeconds = 2.0;
  bool given_up = false;
  TrialBudget budget;
  budget.go_on = [&] { return !(given_up = given_up || !go_on()); };
  budget.time_left = [watch = Stopwatch()] { return watch.seconds() < kSeconds; };
  Progress unwatched;
  try_known(session, active, budget, std::make_shared<ThreadPool>(1), unwatched);
  known = find_known(session, active);
  known_[static_cast<std::size_t>(known - known_.data())].tried = !given_up;
  return known->found && known->found->trial;
}

}  // namespace dmoscope
