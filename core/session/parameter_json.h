#pragma once
// Parameters of a run as JSON: numbers as numbers, all others as words.

#include <nlohmann/json.hpp>

#include "core/base/words.h"
#include "core/run/parameters.h"

namespace dmoscope {

[[nodiscard]] inline nlohmann::json parameter_json(const ParameterInfo& row, const RunParameters& parameters) {
  const std::string text = row.to_text(parameters);
  if (row.kind == ParameterKind::Whole) return to_count(text);
  if (row.kind == ParameterKind::Real) return to_number(text);
  return text;
}

}  // namespace dmoscope
