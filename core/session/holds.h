#pragma once
// Holds of the minima of a session's runs, found once for each moment.

#include <functional>
#include <memory>
#include <vector>

#include "core/run/hints.h"
#include "core/run/trial.h"

namespace dmoscope {

class Session;

class Holds {
 public:
  /// Latest hold found of a run; null: none was.
  struct Latest {
    std::shared_ptr<const HeldMinimum> found;
    bool now = false;  // whether it is of the run's present moment
  };
  [[nodiscard]] Latest of(Session& session, std::size_t run) const;
  /// Finds the hold of a run unless it is known, with a trial of the switch unless `go_on` is given, which means that the user did not ask.
  /// Null if no element has a quality. Throws Cancelled, also once `go_on` returns false, and DeviceError.
  std::shared_ptr<const HeldMinimum> find(Session& session, std::size_t run, Progress& progress, const std::function<bool()>& go_on = {});
  /// Finds the hold of the active run if its mesh is small enough to do so at once. Returns whether there is something new. Throws
  /// DeviceError.
  bool find_at_rest(Session& session, const std::function<bool()>& go_on);
  /// Tries the switch that frees the worst element on a copy of the active run, see try_switch(): on one thread, for some two seconds at
  /// most, and until `go_on` returns false. Once for each moment. Returns whether there is something new. Throws DeviceError.
  bool try_at_rest(Session& session, const std::function<bool()>& go_on);

 private:
  struct Known {
    StandingRun at;
    std::shared_ptr<const HeldMinimum> found;
    bool tried = false;  // whether its switch was tried on the whole mesh
  };
  struct KnownDomain {
    std::weak_ptr<const InputMesh> input;
    StandingRule rule;
    std::shared_ptr<const Domain> domain;
  };
  [[nodiscard]] const Known* find_known(Session& session, std::size_t run) const;
  void try_known(Session& session, std::size_t run, const TrialBudget& budget, const std::shared_ptr<ThreadPool>& pool, Progress& progress);
  [[nodiscard]] std::shared_ptr<const Domain> domain(const std::shared_ptr<const InputMesh>& input, const StandingRule& rule);

  std::vector<Known> known_;          // one for each run
  std::vector<KnownDomain> domains_;  // domains of the latest trials, newest last; they refer to their meshes
};

}  // namespace dmoscope
