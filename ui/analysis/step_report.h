#pragma once
// What a step did: who moved how far, and what it gained. Plain data; no ImGui, no OpenGL.

#include <memory>
#include <optional>
#include <string>

#include "core/view/view.h"
#include "ui/state/view_state.h"

namespace dmoscope::ui {

/// From one moment of a run to a later one, both whole frames of one input by one metric; none where that is not so. `run`: as it stands
/// at the later one.
[[nodiscard]] std::optional<StepNews> report_step(const Frame& before, const Frame& after, const RunView& run);

/// Rather than having come to a number of iterations.
[[nodiscard]] bool has_converged(const RunView& run);
/// How the active run came to its end: "Converged: minimum 0.312 → 0.498, 21 iterations, 0.4 s". The minimum is by the run's own metric.
[[nodiscard]] std::string end_sentence(const RunView& run);

/// Notices when a step of the active run has ended.
class StepWatch {
 public:
  /// Once a frame. `busy`: more is to come. `now`: seconds of any steady clock. Returns after which time the picture changes by itself.
  double follow(ViewState& state, const SessionView& session, bool busy, double now);

 private:
  std::shared_ptr<const Frame> rest_;  // where the last command ended
  std::uint64_t run_ = 0;              // of which run
  std::string outcome_;                // how that had ended
  std::uint64_t messages_ = 0;         // that there were then
};

}  // namespace dmoscope::ui
