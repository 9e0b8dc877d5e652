#pragma once
// Where the vertices were at the begin of the iterations that runs stand in: what a history that is full no longer keeps.

#include <cstdint>
#include <memory>
#include <vector>

#include "core/run/run.h"

namespace dmoscope {

/// One copy of positions a run at most, and none of those that its history keeps.
class IterationStarts {
 public:
  using Positions = std::shared_ptr<const std::vector<Vec3>>;

  /// Of a run that stands at the end of an iteration: remembers its positions, unless they are known. Throws DeviceError.
  void note(const std::weak_ptr<const Run>& run);
  /// The positions at the begin of the iteration that it stands in; null where they are not known here, or are none of its path any more.
  [[nodiscard]] Positions of(const Run& run) const;

 private:
  struct Start {
    std::weak_ptr<const Run> run;
    std::uint64_t iteration = 0;
    Backend backend = Backend::Cpu;  // the last bits may be others after a device failed
    std::vector<Edit> edits;         // all of its path until then
    Positions positions;
    [[nodiscard]] bool is_of(const Run& run) const;
  };
  std::vector<Start> starts_;
};

}  // namespace dmoscope
