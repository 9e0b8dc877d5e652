#include "core/run/ending.h"

#include <cmath>
#include <cstring>
#include <tuple>

#include <fmt/format.h>

#include "core/base/number_text.h"
#include "core/input/mesh_share.h"
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

namespace {

/// Examples that one process knows; numbers are those of the whole mesh. Plain data, which processes exchange as bytes.
struct Examples {
  double jacobian = 1.0;
  std::uint64_t element = kNoIndex, vertex = kNoIndex, around = 0, fixed = 0;
  bool inverted_inside = false;
  Vec3 inside{}, place{};
};

Examples examples_here(const Run& run, std::string& why_fixed) {
  const InputMesh& input = run.input();
  const MeshShare* const share = input.share.get();
  const QualityContext context = input.quality_context();
  const auto positions = run.positions();
  Examples found;
  Index worst = kNoIndex, vertex = kNoIndex;
  std::vector<Index> around(positions.size());
  for (Index e = 0; e < input.mesh.elements.size(); ++e) {
    const double jacobian = smallest_jacobian(context, positions, e) / input.reference_measure[e];
    if (!(jacobian <= 0.0)) continue;
    for (const Index v : input.mesh.elements.corners(e)) ++around[v];
    if ((share == nullptr || share->counts(e)) && jacobian < found.jacobian) worst = e, found.jacobian = jacobian;
  }
  const auto rank = [&](Index v) { return std::tuple(around[v], run.fixed()[v]); };
  for (Index v = 0; v < around.size(); ++v)
    if ((share == nullptr || share->owns(v)) && (vertex == kNoIndex || rank(v) > rank(vertex))) vertex = v;
  if (worst != kNoIndex) {
    const auto inside = inverted_inside(context, positions, worst);
    found.element = share != nullptr ? share->element_numbers()[worst] : worst;
    found.inverted_inside = inside.has_value();
    if (inside) found.inside = in_file(input.mesh, *inside);
  }
  if (vertex != kNoIndex) {
    found.vertex = share != nullptr ? share->vertex_numbers()[vertex] : vertex;
    std::tie(found.around, found.fixed) = rank(vertex);
    found.place = place_in_file(input.mesh, vertex, positions[vertex]);
    why_fixed = run.why_fixed(vertex);
  }
  return found;
}

Index as_index(std::uint64_t number) { return number < kNoIndex ? static_cast<Index>(number) : kNoIndex; }

}  // namespace

std::optional<LeftInverted> find_left_inverted(const Run& run) {
  const QualityContext context = run.input().quality_context();
  const MeshShare* const share = run.input().share.get();
  LeftInverted found;
  found.all = share != nullptr ? count_inverted(context, run.positions(), *share) : count_inverted(context, run.positions());
  if (found.all.all == 0) return std::nullopt;
  std::string why;
  const Examples here = examples_here(run, why);
  const std::string bytes = std::string(reinterpret_cast<const char*>(&here), sizeof(here)) + why;
  Examples worst, first;
  for (const std::string& each : share != nullptr ? share->all_of(bytes) : std::vector{bytes}) {
    Examples there;
    std::memcpy(&there, each.data(), sizeof(there));
    if (std::tuple(there.jacobian, there.element) < std::tuple(worst.jacobian, worst.element)) worst = there;
    if (std::tuple(first.around, first.fixed, there.vertex) < std::tuple(there.around, there.fixed, first.vertex))
      first = there, found.why_fixed = each.substr(sizeof(there));
  }
  found.element = as_index(worst.element);
  if (worst.inverted_inside) found.inside = worst.inside;
  found.vertex = as_index(first.vertex);
  found.around = static_cast<Index>(first.around);
  found.place = first.place;
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
