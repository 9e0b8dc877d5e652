#include "core/run/what_holds.h"

#include "core/smooth/execution/method_table.h"

namespace dmoscope {

std::optional<HeldMinimum> what_holds(const Run& run, ThreadPool* pool, Progress& progress, const DomainSource& domains,
                                      const std::function<bool()>& go_on) {
  const RunParameters& p = run.parameters();
  HeldQuestion question{run.shared_input(), run.positions(), run.fixed(), p.fixed, p.standing()};
  question.domain = run.domain().get();
  question.max_deviation = p.max_deviation;
  question.method = p.method;
  question.metric = p.metric;
  question.search = p.search;
  question.domains = domains;
  if (!method_info(p.method).joint && !p.then_joint) question.joint_phase = p.then_mean ? "joint,mean" : "joint";
  constexpr std::size_t kMostAtRest = 4000;  // nobody has asked for it then
  if (go_on) question.joint_at_most = kMostAtRest;
  return held_minimum(question, pool, progress, go_on);
}

}  // namespace dmoscope
