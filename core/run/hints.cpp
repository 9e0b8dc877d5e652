#include "core/run/hints.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/run/run_task.h"
#include "core/smooth/execution/method_table.h"

namespace dmoscope {

std::string UntanglingHint::sentence() const {
  return fmt::format("{} leaves {} of them after {} iteration{}", method, left, iterations, iterations == 1 ? "" : "s");
}

UntanglingLook untangling_hint(const Run& run, std::shared_ptr<ThreadPool> pool, Progress& progress, const std::function<bool()>& go_on) {
  constexpr std::uint64_t kMostVisits = 2'000'000, kMostIterations = 100;
  const std::uint64_t iterations = std::min(kMostIterations, kMostVisits / std::max<std::uint64_t>(run.visits_per_iteration(), 1));
  const auto check = [&] {
    progress.check();
    if (go_on && !go_on()) throw Cancelled();
  };
  Index fewest = run.history().records()[run.moment().iteration].statistics.inverted;
  UntanglingLook look;
  try {
    for (const MethodInfo& method : method_table()) {
      if (!method.untangles || method.name == run.parameters().method || fewest == 0) continue;
      check();
      RunParameters parameters = run.parameters();
      parameters.method = method.name;
      parameters.combination.reset();
      parameters.then_joint.reset();
      parameters.then_mean.reset();
      parameters.backend = Backend::Cpu;
      if (!why_no_run(run.shared_input(), parameters).empty()) continue;
      Run other(run.shared_input(), std::move(parameters), pool, 0, {}, run.begin());
      other.set_observer([&](const Run&) { check(); });
      for (std::uint64_t i = 1; i <= iterations && fewest > 0; ++i) {
        const Progress::Part part(progress, i - 1, iterations);
        other.step(StepUnit::Iteration, progress);
        const Index left = other.history().records().back().statistics.inverted;
        if (left >= fewest) continue;
        fewest = left;
        look.hint = UntanglingHint{std::string(method.name), left, i};
      }
    }
  } catch (const Cancelled&) {
    look.to_the_end = false;
  }
  return look;
}

std::optional<HeldMinimum> what_holds(const Run& run, ThreadPool* pool, Progress& progress, const HoldLook& look) {
  const RunParameters& p = run.parameters();
  constexpr double kIdeal = 1.0 - 1e-9;
  if (is_built_in(p.metric) && run.statistics().minimum >= kIdeal) return std::nullopt;  // every element is ideal
  SmoothingTask task = task_of(run.shared_input(), p);
  task.guard = run.guard();
  HeldQuestion question{std::move(task), run.positions(), run.fixed(), p.fixed, p.standing(), p.max_deviation};
  question.task.domain = run.domain();
  question.task.aim = run.place_aim();
  question.untangling.floor = run.sweep().untangling.floor;
  question.domains = look.domains;
  RunParameters jointly = p;
  jointly.backend = Backend::Cpu;
  if (!method_info(p.method).joint && !p.then_joint) {
    jointly.then_joint.emplace();
    question.joint_phase = p.then_mean ? "joint,mean" : "joint";
  }
  question.joint = why_no_run(run.shared_input(), jointly).empty();
  // A run that moves vertices jointly looks at large clusters itself. After any other run, and where nobody has asked, the answer is not to
  // take longer than the run.
  constexpr std::size_t kMostInThePlane = 4000, kMostInVolumes = 500;
  if (look.at_rest || !question.joint_phase.empty()) question.joint_at_most = run.input().is_volume() ? kMostInVolumes : kMostInThePlane;
  question.joint_where_it_rises = look.at_rest;
  question.certified = run.last_outcome() && run.last_outcome()->reason == StopReason::Certified;
  return held_minimum(question, pool, progress, look.go_on);
}

}  // namespace dmoscope
