#include "core/run/untangling_hint.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "core/smooth/execution/method_table.h"

namespace dmoscope {

std::string UntanglingHint::sentence() const {
  return fmt::format("{} leaves {} of them after {} iteration{}", method, left, iterations, iterations == 1 ? "" : "s");
}

std::optional<UntanglingHint> untangling_hint(const Run& run, std::shared_ptr<const InputMesh> input, std::shared_ptr<ThreadPool> pool,
                                              Progress& progress, const std::function<bool()>& go_on) {
  constexpr std::uint64_t kMostVisits = 2'000'000, kMostIterations = 100;
  const std::uint64_t iterations = std::min(kMostIterations, kMostVisits / std::max<std::uint64_t>(run.visits_per_iteration(), 1));
  Index fewest = run.history().records()[run.moment().iteration].statistics.inverted;
  std::optional<UntanglingHint> hint;
  for (const MethodInfo& method : method_table()) {
    if (!method.untangles || (input->is_surface() && !method.slides)) continue;
    if (method.name == run.parameters().method || (input->is_volume() && method.planar_only)) continue;
    RunParameters parameters = run.parameters();
    parameters.method = method.name;
    parameters.combination.reset();
    parameters.then_joint.reset();
    parameters.then_mean.reset();
    parameters.backend = Backend::Cpu;
    Run other(input, std::move(parameters), pool, 0);
    if (go_on)
      other.set_observer([&](const Run&) {
        if (!go_on()) throw Cancelled();
      });
    for (std::uint64_t i = 1; i <= iterations && fewest > 0; ++i) {
      other.step(StepUnit::Iteration, progress);
      const Index left = other.history().records().back().statistics.inverted;
      if (left >= fewest) continue;
      fewest = left;
      hint = UntanglingHint{std::string(method.name), left, i};
    }
  }
  return hint;
}

}  // namespace dmoscope
