#pragma once
// How every run fares by the metric that is shown, worked out once for each moment.

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/view/view.h"

namespace dmoscope {

/// A summary of a frame that is whole.
[[nodiscard]] RunSummary summary_of(const Frame& frame);

/// The values at the ranks of an even choice of at most `most` (at least 2): of all of them in ascending order, the first and the last
/// included. NaN is left out.
[[nodiscard]] std::vector<float> sorted_choice(std::vector<float> values, std::size_t most);

/// Summaries of a session's runs.
class Summaries {
 public:
  static constexpr std::size_t kMostSorted = 65536;

  /// Of a run as it stands, by the metric the session shows; null while it has not been worked out.
  [[nodiscard]] std::shared_ptr<const RunSummary> of(Session& session, std::size_t run) const;
  /// Of a mesh as it was read, likewise.
  [[nodiscard]] std::shared_ptr<const InputSummary> of_input(Session& session, const std::shared_ptr<const InputMesh>& input) const;
  /// Works out those that are missing, asking `go_on` before each. `whole`: the frame of a run as it stands where there is one, else null.
  /// Returns whether there are new ones.
  bool find(Session& session, const std::function<const Frame*(std::size_t)>& whole, const std::function<bool()>& go_on);

 private:
  struct Known {
    StandingRun at;
    std::shared_ptr<const RunSummary> summary;
  };
  [[nodiscard]] SizeCourse sizes_of(Session& session, std::size_t run, std::span<const Vec3> positions) const;
  struct KnownInput {
    std::weak_ptr<const InputMesh> input;
    StandingRule rule{};  // what stays there, as for its run that is active, or its first one
    std::shared_ptr<const InputSummary> summary;
  };
  bool find_inputs(Session& session, const std::function<bool()>& go_on);
  [[nodiscard]] static StandingRule rule_of(Session& session, const std::shared_ptr<const InputMesh>& input);
  std::vector<Known> known_;        // one a run
  std::vector<KnownInput> inputs_;  // one a mesh
};

}  // namespace dmoscope
