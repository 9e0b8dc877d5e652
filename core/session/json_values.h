#pragma once
// Numbers and lists in the JSON of saved sessions.

#include <cstdint>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/vec.h"

namespace dmoscope {

using StateJson = nlohmann::ordered_json;

/// Number as JSON; as words "nan", "inf" and "-inf" if it is not finite, which JSON numbers cannot be.
[[nodiscard]] StateJson number_in_json(double value);
/// Reads such a number. Throws UsageError if it is none, and exceptions of the JSON library; so do the functions below.
[[nodiscard]] double to_double(const StateJson& json);
[[nodiscard]] std::uint64_t to_whole(const StateJson& json);
[[nodiscard]] Index to_index(const StateJson& json);
[[nodiscard]] std::vector<Index> to_indices(const StateJson& json);

}  // namespace dmoscope
