#include "core/run/untangling_hint.h"

#include <algorithm>
#include <string_view>
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
      Run other(run.shared_input(), std::move(parameters), pool, 0);
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

}  // namespace dmoscope
