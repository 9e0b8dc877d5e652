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
  // A run that moves vertices jointly looks at large clusters itself. After any other, and where nobody has asked, the answer is not to
  // take longer than the run.
  constexpr std::size_t kMostInThePlane = 4000, kMostInVolumes = 500;
  if (go_on || !question.joint_phase.empty()) question.joint_at_most = run.input().is_volume() ? kMostInVolumes : kMostInThePlane;
  question.joint_where_it_rises = static_cast<bool>(go_on);  // at rest, where the holders are drawn
  return held_minimum(question, pool, progress, go_on);
}

}  // namespace dmoscope
