#pragma once
// What holds the minima of a session's runs, worked out once for each moment.

#include <functional>
#include <memory>
#include <vector>

#include "core/run/hints.h"
#include "core/run/trial.h"

namespace dmoscope {

class Session;

class Holds {
 public:
  /// Of a run as it stood when that was worked out last; null: it never was.
  struct Latest {
    std::shared_ptr<const HeldMinimum> found;
    bool now = false;  // it is of the run as it stands
  };
  [[nodiscard]] Latest of(Session& session, std::size_t run) const;
  /// Works it out where it is missing, with a trial of the switch unless `go_on` is given: nobody has asked then. Null where no element has
  /// a quality. Throws Cancelled, also once `go_on` says no, and DeviceError.
  std::shared_ptr<const HeldMinimum> find(Session& session, std::size_t run, Progress& progress, const std::function<bool()>& go_on = {});
  /// Works it out for the active run, of a mesh on which that takes no time to speak of. Returns whether there is something new. Throws
  /// DeviceError.
  bool find_at_rest(Session& session, const std::function<bool()>& go_on);
  /// Tries on a copy of the active run what it would come to by the switch that frees its worst element, see try_switch(): on one thread,
  /// for some two seconds at most, and given up once `go_on` says no. Once for each moment. Returns whether there is something new. Throws
  /// DeviceError.
  bool try_at_rest(Session& session, const std::function<bool()>& go_on);

 private:
  struct Known {
    StandingRun at;
    std::shared_ptr<const HeldMinimum> found;
    bool tried = false;  // its switch, on the whole mesh
  };
  struct KnownDomain {
    std::weak_ptr<const InputMesh> input;
    StandingRule rule;
    std::shared_ptr<const Domain> domain;
  };
  [[nodiscard]] const Known* find_known(Session& session, std::size_t run) const;
  void try_known(Session& session, std::size_t run, const TrialBudget& budget, const std::shared_ptr<ThreadPool>& pool, Progress& progress);
  [[nodiscard]] std::shared_ptr<const Domain> domain(const std::shared_ptr<const InputMesh>& input, const StandingRule& rule);

  std::vector<Known> known_;          // one a run
  std::vector<KnownDomain> domains_;  // of what was tried last, latest last; they look into their meshes
};

}  // namespace dmoscope
