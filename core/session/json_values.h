#pragma once
// Numbers and lists in the JSON of saved sessions.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/base64.h"
#include "core/base/vec.h"
#include "core/base/words.h"
#include "core/run/history.h"
#include "core/run/parameters.h"

namespace dmoscope {

using StateJson = nlohmann::ordered_json;

/// Number as JSON; as words "nan", "inf" and "-inf" if it is not finite, which JSON numbers cannot be.
[[nodiscard]] StateJson number_in_json(double value);
/// Reads such a number. Throws UsageError if it is none, and exceptions of the JSON library; so do the functions below.
[[nodiscard]] double to_double(const StateJson& json);
[[nodiscard]] std::uint64_t to_whole(const StateJson& json);
[[nodiscard]] Index to_index(const StateJson& json);
[[nodiscard]] std::vector<Index> to_indices(const StateJson& json);

// Joint moves in a saved session.

/// Figures as an array: ["none" | "certified" | "no gain", certified, is push, bound, gap, vertices, Newton steps].
[[nodiscard]] StateJson joint_json(const JointFigures& figures);
/// Reads such an array. Throws UsageError, and exceptions of the JSON library.
[[nodiscard]] JointFigures to_joint_figures(const StateJson& json);

/// State as an object: atoms in stretches, state and count alternating; levels as pairs of vertex and level.
[[nodiscard]] StateJson joint_json(const JointState& state);
/// Reads such an object. `vertices`: number of the mesh's vertices. Throws UsageError, and exceptions of the JSON library.
[[nodiscard]] JointState to_joint_state(const StateJson& json, std::size_t vertices);

// Positions as text (RFC 4648).

/// Positions as the base64 of their coordinates, x y z x y z ..., little-endian doubles, without loss.
[[nodiscard]] std::string pack_positions(std::span<const Vec3> positions);
/// Reads such a text. None unless it holds exactly `count` finite positions.
[[nodiscard]] std::optional<std::vector<Vec3>> unpack_positions(std::string_view text, std::size_t count);

// Parameters of a run as JSON: numbers as numbers, all others as words.

[[nodiscard]] inline nlohmann::json parameter_json(const ParameterInfo& row, const RunParameters& parameters) {
  const std::string text = row.to_text(parameters);
  if (row.kind == ParameterKind::Whole) return to_count(text);
  if (row.kind == ParameterKind::Real) return to_number(text);
  return text;
}

}  // namespace dmoscope
