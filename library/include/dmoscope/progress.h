#pragma once
// Long work reports here, and learns here that it shall stop.

#include <memory>
#include <string>

#include "dmoscope/export.h"

namespace dmo {

/// Shared by the thread that works and those that watch: all members may be called from any thread. A copy is the same.
class DMO_API Progress {
 public:
  Progress();
  ~Progress();
  Progress(const Progress&);
  Progress& operator=(const Progress&);
  /// Fraction that is done of the step under way, 0 to 1.
  [[nodiscard]] double fraction() const;
  /// The step under way: "reading east.14".
  [[nodiscard]] std::string label() const;
  /// The work ends within some 50 ms. smooth() gives back what it has until then; all others throw Cancelled.
  void request_cancel();

  struct State;
  [[nodiscard]] State& state() const noexcept { return *state_; }

 private:
  std::shared_ptr<State> state_;
};

}  // namespace dmo
