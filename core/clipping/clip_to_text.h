#pragma once
// A clip plane in words.

#include <string_view>

#include "core/clipping/clipped_view.h"

namespace dmoscope {

/// "x", "y" or "z": a plane across that axis, half-way from `low` to `high` or at ":FRACTION" (0 to 1). The side of greater coordinates is
/// taken away; with a minus before the letter the other side. Or "NX,NY,NZ:OFFSET": ClipPlane's numbers. It is on. Throws UsageError.
[[nodiscard]] ClipPlane parse_clip(std::string_view words, Vec3 low, Vec3 high);

/// "crinkle" or "cut". Throws UsageError.
[[nodiscard]] ClipPlane::Mode parse_clip_mode(std::string_view word);

}  // namespace dmoscope
