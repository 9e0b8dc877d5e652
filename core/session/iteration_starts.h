#pragma once
// Positions at the begin of the iterations that runs are in, for histories that are full and no longer keep them.

#include <cstdint>
#include <memory>
#include <vector>

#include "core/run/run.h"

namespace dmoscope {

/// Positions at the begin of iterations, at most one copy for each run, and none that its history keeps.
class IterationStarts {
 public:
  using Positions = std::shared_ptr<const std::vector<Vec3>>;

  /// Keeps the positions of a run that is at the end of an iteration, unless they are known. Throws DeviceError.
  void note(const std::weak_ptr<const Run>& run);
  /// The positions at the begin of the run's present iteration; null if they are not known here, or do not belong to its path any more.
  [[nodiscard]] Positions of(const Run& run) const;

 private:
  struct Start {
    std::weak_ptr<const Run> run;
    std::uint64_t iteration = 0;
    Backend backend = Backend::Cpu;  // backend at that moment: the last bits may differ after a device failed
    std::vector<Edit> edits;         // all edits of its path up to then
    Positions positions;
    [[nodiscard]] bool is_of(const Run& run) const;
  };
  std::vector<Start> starts_;
};

}  // namespace dmoscope
