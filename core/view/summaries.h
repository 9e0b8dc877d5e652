#pragma once
// Summaries of every run by the shown metric, computed once for each moment.

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/view/view.h"

namespace dmoscope {

/// Summary of a whole frame.
[[nodiscard]] RunSummary summary_of(const Frame& frame);

/// The values at evenly spaced ranks, at most `most` (at least 2) of them, ascending, with the first and the last. NaN is ignored.
[[nodiscard]] std::vector<float> sorted_choice(std::vector<float> values, std::size_t most);

/// Summaries of a session's runs.
class Summaries {
 public:
  static constexpr std::size_t kMostSorted = 65536;

  /// Summary of a run's present state, by the shown metric; null until it is computed.
  [[nodiscard]] std::shared_ptr<const RunSummary> of(Session& session, std::size_t run) const;
  /// Summary of a mesh as it was read; null until it is computed.
  [[nodiscard]] std::shared_ptr<const InputSummary> of_input(Session& session, const std::shared_ptr<const InputMesh>& input) const;
  /// Computes missing summaries, asking `go_on` before each. `whole`: returns the frame of a run's present state if there is one, else
  /// null. Returns whether there are new ones.
  bool find(Session& session, const std::function<const Frame*(std::size_t)>& whole, const std::function<bool()>& go_on);

 private:
  struct Known {
    StandingRun at;
    std::shared_ptr<const RunSummary> summary;
  };
  [[nodiscard]] SizeCourse sizes_of(Session& session, std::size_t run, std::span<const Vec3> positions) const;
  struct KnownInput {
    std::weak_ptr<const InputMesh> input;
    StandingRule rule{};  // rule of its fixed vertices, that of its active run or of its first one
    std::shared_ptr<const InputSummary> summary;
  };
  bool find_inputs(Session& session, const std::function<bool()>& go_on);
  [[nodiscard]] static StandingRule rule_of(Session& session, const std::shared_ptr<const InputMesh>& input);
  std::vector<Known> known_;        // one for each run
  std::vector<KnownInput> inputs_;  // one for each mesh
};

}  // namespace dmoscope
