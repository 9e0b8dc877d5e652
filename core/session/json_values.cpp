#include "core/session/json_values.h"

#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "core/base/error.h"

namespace dmoscope {

StateJson number_in_json(double value) {
  return std::isnan(value) ? StateJson("nan") : std::isinf(value) ? StateJson(value > 0 ? "inf" : "-inf") : StateJson(value);
}

double to_double(const StateJson& json) {
  if (json.is_number()) return json.get<double>();
  const auto word = json.get<std::string>();
  if (word == "inf") return std::numeric_limits<double>::infinity();
  if (word == "-inf") return -std::numeric_limits<double>::infinity();
  if (word == "nan") return std::numeric_limits<double>::quiet_NaN();
  throw UsageError(fmt::format("'{}' is no number", word));
}

std::uint64_t to_whole(const StateJson& json) {
  if (!json.is_number_unsigned()) throw UsageError("a whole number is expected where there is none");
  return json.get<std::uint64_t>();
}

Index to_index(const StateJson& json) {
  const std::uint64_t value = to_whole(json);
  if (value >= kNoIndex) throw UsageError(fmt::format("{} is too large an index", value));
  return static_cast<Index>(value);
}

std::vector<Index> to_indices(const StateJson& json) {
  if (!json.is_array()) throw UsageError("a list of vertices is expected where there is none");
  std::vector<Index> indices;
  for (const StateJson& entry : json) indices.push_back(to_index(entry));
  return indices;
}

}  // namespace dmoscope
