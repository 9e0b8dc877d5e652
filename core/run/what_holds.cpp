#include "core/run/what_holds.h"

#include "core/run/run_task.h"
#include "core/smooth/execution/method_table.h"

namespace dmoscope {

std::optional<HeldMinimum> what_holds(const Run& run, ThreadPool* pool, Progress& progress, const HoldLook& look) {
  const RunParameters& p = run.parameters();
  HeldQuestion question{task_of(run.shared_input(), p), run.positions(), run.fixed(), p.fixed, p.standing(), p.max_deviation};
  question.task.domain = run.domain();
  question.task.size = run.size_field();
  question.untangling.floor = run.sweep().untangling.floor;
  question.domains = look.domains;
  RunParameters jointly = p;
  jointly.backend = Backend::Cpu;
  if (!method_info(p.method).joint && !p.then_joint) {
    jointly.then_joint.emplace();
    question.joint_phase = p.then_mean ? "joint,mean" : "joint";
  }
  question.joint = why_no_run(run.shared_input(), jointly).empty();
  // A run that moves vertices jointly looks at large clusters itself. After any other, and where nobody has asked, the answer is not to
  // take longer than the run.
  constexpr std::size_t kMostInThePlane = 4000, kMostInVolumes = 500;
  if (look.at_rest || !question.joint_phase.empty()) question.joint_at_most = run.input().is_volume() ? kMostInVolumes : kMostInThePlane;
  question.joint_where_it_rises = look.at_rest;
  question.whole = !look.at_rest;
  return held_minimum(question, pool, progress, look.go_on);
}

}  // namespace dmoscope
