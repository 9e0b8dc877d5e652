#include "core/run/mean_given_up.h"

#include <cmath>

#include <fmt/format.h>

#include "core/base/number_text.h"
#include "core/smooth/execution/method_table.h"

namespace dmoscope {

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

}  // namespace dmoscope
