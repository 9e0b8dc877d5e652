#include "core/quality/power_mean.h"

#include <algorithm>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/unknown_value.h"

namespace dmoscope {

std::string_view name(MeanKind kind) {
  switch (kind) {
    case MeanKind::Arithmetic:
      return "arithmetic-mean";
    case MeanKind::Geometric:
      return "geometric-mean";
    case MeanKind::InverseSquare:
      return "inverse-square-mean";
    case MeanKind::Harmonic:
      break;
  }
  return "mean";
}

MeanKind parse_mean_kind(std::string_view word) {
  const auto found = std::ranges::find(kMeanKinds, word, [](MeanKind each) { return name(each); });
  if (found != kMeanKinds.end()) return *found;
  std::vector<std::string_view> choices;
  for (const MeanKind each : kMeanKinds) choices.push_back(name(each));
  throw UsageError(unknown_value("mean", std::string(word), choices));
}

}  // namespace dmoscope
