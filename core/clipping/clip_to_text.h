#pragma once
// A clip plane in words.

#include <string_view>

#include "core/clipping/clipped_view.h"

namespace dmoscope {

/// "x", "y" or "z", or with a minus before it: across that axis half-way from `low` to `high`, or with ":FRACTION" (0 to 1) elsewhere; what
/// has more of it is taken away, with a minus what has less. Or "NX,NY,NZ:OFFSET": ClipPlane's numbers. The plane is on. Throws UsageError.
[[nodiscard]] ClipPlane parse_clip(std::string_view words, Vec3 low, Vec3 high);

/// "crinkle" or "cut". Throws UsageError.
[[nodiscard]] ClipPlane::Mode parse_clip_mode(std::string_view word);

}  // namespace dmoscope
