#pragma once
// Clip planes in words.

#include <string_view>

#include "core/clipping/clipped_view.h"

namespace dmoscope {

/// Parses a clip plane: "x", "y" or "z" is a plane across that axis, half-way from `low` to `high` or at ":FRACTION" (0 to 1), which takes
/// away the side of greater coordinates; with a minus before the letter the other side. "NX,NY,NZ:OFFSET" has ClipPlane's numbers. The
/// plane is switched on. Throws UsageError.
[[nodiscard]] ClipPlane parse_clip(std::string_view words, Vec3 low, Vec3 high);

/// Parses "crinkle" or "cut". Throws UsageError.
[[nodiscard]] ClipPlane::Mode parse_clip_mode(std::string_view word);

}  // namespace dmoscope
