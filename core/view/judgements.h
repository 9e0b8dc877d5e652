#pragma once
// Judgements of every run by every metric that a run optimises, for comparisons of metrics.

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "core/session/session.h"
#include "core/view/view.h"

namespace dmoscope {

/// The metrics of a comparison: the shown one, then those that runs optimise, each once. A metric that is not defined for a mesh judges no
/// run on it.
[[nodiscard]] std::vector<Metric> compared_metrics(Session& session);

/// Iterations at which the course of a run is judged by the metrics of others, ascending. Of `count` records (the first is the input) they
/// are all of the first ones, then fewer and fewer, and the last.
[[nodiscard]] std::vector<std::uint64_t> judged_iterations(std::uint64_t count);

/// Judgements of a session's runs, computed while it is at rest; for sessions of one run there are none.
class Judgements {
 public:
  /// The judgements of a run; null until some are computed.
  [[nodiscard]] std::shared_ptr<const std::vector<JudgedBy>> of(Session& session, std::size_t run) const;
  [[nodiscard]] std::shared_ptr<const std::vector<JudgedBy>> of_input(Session& session,
                                                                      const std::shared_ptr<const InputMesh>& input) const;
  /// Judges inputs, and runs in their present state. Asks `go_on` before each. Returns whether there are new judgements.
  bool find(Session& session, const std::function<bool()>& go_on);
  /// Judges earlier iterations whose positions are kept. Asks `go_on` before each. Returns whether there are new judgements.
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
