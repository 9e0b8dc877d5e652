#include "core/run/missing_phase.h"

namespace dmoscope {

std::vector<std::string> missing_phases(const Run& run, const Outcome& outcome) {
  std::vector<std::string> sentences;
  const RunPhases phases = run.phases();
  if (run.parameters().then_joint && !phases.joint_since)
    sentences.emplace_back("vertices were not moved jointly, because the minimum had not converged yet (add --until-converged)");
  if (!run.parameters().then_mean || phases.mean_since) return sentences;
  sentences.emplace_back(outcome.inverted > 0
                             ? "the mean was not raised: that begins only once no element is inverted"
                             : "the mean was not raised, because the minimum had not converged yet (add --until-converged)");
  return sentences;
}

}  // namespace dmoscope
