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
  /// Fraction of the present step that is done, 0 to 1.
  [[nodiscard]] double fraction() const;
  /// Description of the present step: "reading east.14".
  [[nodiscard]] std::string label() const;
  /// Asks the work to end, which takes some 50 ms. smooth() returns its result so far; all other functions throw Cancelled.
  void request_cancel();

  struct State;
  [[nodiscard]] State& state() const noexcept { return *state_; }

 private:
  std::shared_ptr<State> state_;
};

}  // namespace dmo
