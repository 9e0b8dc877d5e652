#pragma once
// Trials: short runs on a copy that find out what other parameters make of a run's minimum.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "core/inspect/held_minimum.h"
#include "core/run/run.h"

namespace dmoscope {

/// Changes parameters as the switch's command does.
void apply_switch(const HoldSwitch& change, RunParameters& parameters);

/// State that a trial begins from.
struct TrialBegin {
  BeginPositions positions;             // null: those of the run's own begin
  std::optional<std::uint64_t> from{};  // see SwitchTrial
};

/// Limits for a trial.
struct TrialBudget {
  std::uint64_t iterations = 20;      // iterations of the phase that is tried
  std::uint64_t visits = 2'000'000;   // visits in all; those of volumes count tenfold
  std::function<bool()> go_on{};      // asks whether to go on; no: the trial is given up; empty: yes
  std::function<bool()> time_left{};  // asks whether time is left; no: the trial ends with the iterations that it has done; empty: yes
};

/// Lets a copy of the run go on from `begin` with the switches that `held` names, on the CPU, as `continue-with` would: the run itself does
/// not move. Where more iterations raise the minimum anyway, `held.rises()`, that is tried as well, and only what switches add to it is a
/// gain. Returns none where there is no switch, a run cannot be so, or the budget ends before there is an iteration or a gain, and where it
/// was given up.
[[nodiscard]] std::optional<SwitchTrial> try_switch(const Run& run, const HeldMinimum& held, const TrialBegin& begin,
                                                    const TrialBudget& budget, std::shared_ptr<ThreadPool> pool, Progress& progress);

}  // namespace dmoscope
