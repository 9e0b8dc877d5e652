#pragma once
// How every run fares by every metric that a run optimises: what a comparison of metrics shows.

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "core/session/session.h"
#include "core/view/view.h"

namespace dmoscope {

/// The metrics that a comparison judges by: the one that is shown, then those that runs optimise, each once. Those that are not defined for
/// a mesh judge no run on it.
[[nodiscard]] std::vector<Metric> compared_metrics(Session& session);

/// Iterations at which the course of a run is judged by the metrics of others, ascending: of `count` records (the input is the first) all
/// of the first ones, then fewer and fewer, and the last.
[[nodiscard]] std::vector<std::uint64_t> judged_iterations(std::uint64_t count);

/// Judgements of a session's runs, worked out while it is at rest; of sessions of one run there are none.
class Judgements {
 public:
  /// Null while nothing has been worked out.
  [[nodiscard]] std::shared_ptr<const std::vector<JudgedBy>> of(Session& session, std::size_t run) const;
  [[nodiscard]] std::shared_ptr<const std::vector<JudgedBy>> of_input(Session& session,
                                                                      const std::shared_ptr<const InputMesh>& input) const;
  /// Of inputs, and of runs as they stand. Asks `go_on` before each. Returns whether there are new ones.
  bool find(Session& session, const std::function<bool()>& go_on);
  /// Of the iterations before, where their positions are kept.
  bool find_courses(Session& session, const std::function<bool()>& go_on);

 private:
  struct Known {
    StandingRun at;
    std::shared_ptr<const std::vector<JudgedBy>> by;
  };
  struct KnownInput {
    std::weak_ptr<const InputMesh> input;
    std::shared_ptr<const std::vector<JudgedBy>> by;
  };
  [[nodiscard]] Known* known(Session& session, std::size_t run);
  bool find_inputs(Session& session, const std::vector<Metric>& metrics, const std::function<bool()>& go_on);
  bool judge_course(Session& session, std::size_t run, JudgedBy& by, const std::function<bool()>& go_on) const;

  std::vector<Known> known_;
  std::vector<KnownInput> inputs_;
};

}  // namespace dmoscope
