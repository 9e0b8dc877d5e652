#pragma once
// Findings about runs that came to their end: report card, inverted elements, and faces that cross each other. Computed once for each end.

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/run/crossing_faces.h"
#include "core/run/ending.h"
#include "core/run/hints.h"
#include "core/run/report_card.h"
#include "core/session/session.h"

namespace dmoscope {

struct RunEnding {
  std::optional<LeftInverted> left{};
  std::optional<UntanglingHint> hint{};
  std::optional<CrossingFaces> crossing{};
  ReportCard card{};
};

/// The endings of a session's runs.
class Endings {
 public:
  /// The ending of a run; null while the run has not ended, and until the ending is computed.
  [[nodiscard]] std::shared_ptr<const RunEnding> of(Session& session, std::size_t run) const;
  /// Computes missing endings, asking `go_on` before each. Returns whether there are new ones. Throws DeviceError.
  bool find(Session& session, const std::function<bool()>& go_on);
  /// Tries whether another method gets further than the active run, once if `go_on` lets the trial finish. Returns whether one does.
  bool find_hint(Session& session, const std::function<bool()>& go_on);

 private:
  struct Known {
    StandingRun at;
    std::shared_ptr<const RunEnding> ending;
    bool tried = false;  // whether other methods were tried
  };
  [[nodiscard]] const Known* find_known(Session& session, std::size_t run) const;
  std::vector<Known> known_;
};

}  // namespace dmoscope
