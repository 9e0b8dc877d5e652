#include "core/run/left_inverted.h"

#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "core/smooth/execution/method_table.h"

namespace dmoscope {

std::string LeftInverted::sentence() const {
  std::string text = all.all == 1 ? "1 element stays inverted. " : fmt::format("{} elements stay inverted. ", all.all);
  const auto words = [](Vec3 p) { return fmt::format("({:.10g}, {:.10g}, {:.10g})", p.x, p.y, p.z); };
  text += fmt::format("Look at element {}", element);
  if (inside) text += fmt::format(", which is inverted inside, at {}, where its corners do not tell,", words(*inside));
  text += fmt::format(" and at vertex {} at {}", vertex, words(place));
  if (all.all > 1) text += fmt::format(", which is in {} of them", around);
  return why_fixed.empty() ? text + "." : fmt::format("{}; {}.", text, why_fixed);
}

std::optional<LeftInverted> find_left_inverted(const Run& run) {
  const InputMesh& input = run.input();
  const QualityContext context = input.quality_context();
  const auto positions = run.positions();
  LeftInverted found;
  double least = 0.0;
  std::vector<Index> around(positions.size());
  for (Index e = 0; e < input.mesh.elements.size(); ++e) {
    const double jacobian = smallest_jacobian(context, positions, e) / input.reference_measure[e];
    if (!(jacobian <= 0.0)) continue;
    found.all.add(context, positions, e, e);
    if (found.all.all == 1 || jacobian < least) {
      least = jacobian;
      found.element = e;
    }
    for (const Index v : input.mesh.elements.corners(e)) ++around[v];
  }
  if (found.all.all == 0) return std::nullopt;
  const auto rank = [&](Index v) { return std::tuple(around[v], run.fixed()[v]); };
  found.inside = inverted_inside(context, positions, found.element);
  found.vertex = 0;
  for (Index v = 1; v < around.size(); ++v)
    if (rank(v) > rank(found.vertex)) found.vertex = v;
  found.around = around[found.vertex];
  found.place = positions[found.vertex];
  found.why_fixed = run.why_fixed(found.vertex);
  return found;
}

std::uint64_t best_iteration(const Run& run) { return best_iteration(run.parameters(), run.history().records()); }

std::string iteration_name(std::uint64_t iteration) {
  return iteration == 0 ? std::string("the input itself") : fmt::format("iteration {}", iteration);
}

std::string worse_than_best(const RunParameters& parameters, std::uint64_t best, std::uint64_t last) {
  if (best == last || method_info(parameters.method).optimises) return {};
  return fmt::format("{} {}: the best iteration was {}, not iteration {}", parameters.method, kMayMakeWorse, iteration_name(best), last);
}

}  // namespace dmoscope
