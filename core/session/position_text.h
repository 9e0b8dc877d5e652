#pragma once
// Positions as text (RFC 4648).

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/base64.h"
#include "core/base/vec.h"

namespace dmoscope {

/// Positions as the base64 of their coordinates, x y z x y z ..., little-endian doubles, without loss.
[[nodiscard]] std::string pack_positions(std::span<const Vec3> positions);
/// Reads such a text. None unless it holds exactly `count` finite positions.
[[nodiscard]] std::optional<std::vector<Vec3>> unpack_positions(std::string_view text, std::size_t count);

}  // namespace dmoscope
