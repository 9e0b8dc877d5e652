#pragma once
// Numbers and lists in the JSON of saved sessions.

#include <cstdint>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/vec.h"

namespace dmoscope {

using StateJson = nlohmann::ordered_json;

/// JSON has no number for what is not finite: "nan", "inf" and "-inf" are words.
[[nodiscard]] StateJson number_in_json(double value);
/// The way back. Throws UsageError for what is no number, or what the JSON library throws; so do those below.
[[nodiscard]] double to_double(const StateJson& json);
[[nodiscard]] std::uint64_t to_whole(const StateJson& json);
[[nodiscard]] Index to_index(const StateJson& json);
[[nodiscard]] std::vector<Index> to_indices(const StateJson& json);

}  // namespace dmoscope
