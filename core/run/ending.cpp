#include "core/run/ending.h"

#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include "core/base/number_text.h"
#include "core/mesh/geographic.h"
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
  if (found.inside) found.inside = in_file(input.mesh, *found.inside);
  found.vertex = 0;
  for (Index v = 1; v < around.size(); ++v)
    if (rank(v) > rank(found.vertex)) found.vertex = v;
  found.around = around[found.vertex];
  found.place = place_in_file(input.mesh, found.vertex, positions[found.vertex]);
  found.why_fixed = run.why_fixed(found.vertex);
  return found;
}

std::uint64_t best_iteration(const Run& run) { return best_iteration(run.parameters(), run.history().records()); }

std::string iteration_name(std::uint64_t iteration) {
  return iteration == 0 ? std::string("the start") : fmt::format("iteration {}", iteration);
}

std::string worse_than_best(const RunParameters& parameters, std::uint64_t best, std::uint64_t last) {
  if (best == last || method_info(parameters.method).optimises) return {};
  return fmt::format("{} {}: the best iteration was {}, not iteration {}", parameters.method, kMayMakeWorse, iteration_name(best), last);
}

std::string course_text(std::span<const IterationRecord> records, std::uint64_t iteration) {
  const auto text = [](double value) { return std::isfinite(value) ? four_digits(value) : std::string("-"); };
  const Statistics &input = records.front().statistics, &now = records[iteration].statistics;
  return fmt::format("minimum {} -> {}, mean {} -> {}", text(input.minimum), text(now.minimum), text(input.mean), text(now.mean));
}

std::string mean_given_up(const RunParameters& parameters, std::span<const IterationRecord> records, std::uint64_t iteration) {
  constexpr double kMuch = 0.005;
  if (parameters.then_mean || parameters.combination || !method_info(parameters.method).optimises || iteration >= records.size()) return {};
  if (records[iteration].statistics.inverted > 0) return {};
  std::uint64_t best = iteration;
  for (std::uint64_t i = iteration + 1; i-- > 0 && records[i].statistics.inverted == 0;)
    if (records[i].statistics.mean > records[best].statistics.mean) best = i;
  const double had = records[best].statistics.mean, has = records[iteration].statistics.mean;
  if (!(had - has > kMuch)) return {};
  return fmt::format(
      "the mean fell from {:.3f} ({}) to {:.3f} for the sake of the worst element; a second phase raises it and keeps the minimum", had,
      best == 0 ? "the input" : fmt::format("iteration {}", best), has);
}

std::string made_worse(const RunParameters& parameters, std::span<const IterationRecord> records, std::uint64_t iteration) {
  if (method_info(parameters.method).optimises || iteration >= records.size()) return {};
  const Statistics &input = records.front().statistics, &now = records[iteration].statistics;
  if (now.inverted > input.inverted)
    return fmt::format("{} made elements worse: {} {} inverted now, {} before", parameters.method, now.inverted,
                       now.inverted == 1 ? "is" : "are", input.inverted);
  if (!(now.minimum < input.minimum)) return {};
  return fmt::format("{} made elements worse: the minimum fell from {} to {}", parameters.method, four_digits(input.minimum),
                     four_digits(now.minimum));
}

std::vector<std::string> missing_phases(const Run& run) {
  std::vector<std::string> sentences;
  const RunPhases phases = run.phases();
  if (run.parameters().then_joint && !phases.joint_since)
    sentences.emplace_back("vertices were not moved jointly, because the minimum had not converged yet (add --until-converged)");
  if (run.parameters().then_mean && !phases.mean_since)
    sentences.emplace_back("the mean was not raised, because the minimum had not converged yet (add --until-converged)");
  return sentences;
}

}  // namespace dmoscope
