#pragma once
// Progress of long work, and requests to stop it.

#include <memory>
#include <string>

#include "dmoscope/export.h"

namespace dmo {

/// Progress shared by the thread that works and those that watch: all members may be called from any thread. Copies share their state.
class DMO_API Progress {
 public:
  Progress();
  ~Progress();
  Progress(const Progress&);
  Progress& operator=(const Progress&);
  /// Fraction of the present step that is done, 0 to 1; of smooth() with until_converged: that of max_iterations, which it seldom needs.
  [[nodiscard]] double fraction() const;
  /// Description of the present step: "reading east.14", "smoothing".
  [[nodiscard]] std::string label() const;
  /// Asks the work to end, which takes some 50 ms. smooth() returns its result so far; all other functions throw Cancelled.
  void request_cancel();
  /// Forgets a requested cancel, so that the same progress can watch another call.
  void reset();

  struct State;
  [[nodiscard]] State& state() const noexcept { return *state_; }

 private:
  std::shared_ptr<State> state_;
};

}  // namespace dmo
