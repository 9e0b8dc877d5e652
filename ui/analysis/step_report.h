#pragma once
// Report on a step: which vertices moved how far, and its gain. Plain data; no ImGui, no OpenGL.

#include <memory>
#include <optional>
#include <string>

#include "core/view/view.h"
#include "ui/state/view_state.h"

namespace dmoscope::ui {

/// Whether a run has converged, rather than reached a number of iterations.
[[nodiscard]] bool has_converged(const RunView& run);
/// Sentence on the end of the active run: "Converged: minimum 0.312 → 0.498, 21 iterations, 0.4 s". The minimum is by the run's own metric.
[[nodiscard]] std::string end_sentence(const RunView& run);

/// Notices when a step of the active run has ended.
class StepWatch {
 public:
  /// Looks for an ended step, once a frame. `busy`: more is to come. `now`: seconds of any steady clock. Returns the seconds after which
  /// the picture changes by itself.
  double follow(ViewState& state, const SessionView& session, bool busy, double now);

 private:
  std::shared_ptr<const Frame> rest_;  // frame after the last command
  std::uint64_t run_ = 0;              // run that these belong to
  std::string outcome_;                // end of that run at the time
  std::uint64_t messages_ = 0;         // number of messages at the time
};

}  // namespace dmoscope::ui
