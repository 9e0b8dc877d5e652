#pragma once
// Whether a device runs this program's kernels, and computes as the processor does.

#include <string>

namespace dmoscope::gpu {

/// Runs a tiny kernel on device number `device`. Empty when that works and its arithmetic gives the bits that the processor's does
/// (no contraction, no flushed subnormals, IEEE division and square root); otherwise what is wrong, as part of a sentence. Never throws.
/// The device stays the calling thread's.
[[nodiscard]] std::string probe(int device);

}  // namespace dmoscope::gpu
