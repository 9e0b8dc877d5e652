#include "core/run/mean_given_up.h"

#include <fmt/format.h>

#include "core/smooth/execution/method_table.h"

namespace dmoscope {

std::string mean_given_up(const Run& run) {
  constexpr double kMuch = 0.02;
  const RunParameters& parameters = run.parameters();
  const auto& records = run.history().records();
  const std::uint64_t last = run.moment().iteration;
  if (parameters.then_mean || parameters.combination || !method_info(parameters.method).optimises || last >= records.size()) return {};
  if (records[last].statistics.inverted > 0) return {};
  std::uint64_t best = last;
  for (std::uint64_t i = last + 1; i-- > 0 && records[i].statistics.inverted == 0;)
    if (records[i].statistics.mean > records[best].statistics.mean) best = i;
  const double had = records[best].statistics.mean, has = records[last].statistics.mean;
  if (!(had - has > kMuch)) return {};
  return fmt::format(
      "the mean fell from {:.3f} ({}) to {:.3f} for the sake of the worst element; a second phase raises it and keeps the minimum", had,
      best == 0 ? "the input" : fmt::format("iteration {}", best), has);
}

}  // namespace dmoscope
