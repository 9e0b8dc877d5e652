#pragma once
// Test whether a device runs this program's kernels, and computes as the processor does.

#include <string>

namespace dmoscope::gpu {

/// Runs a tiny kernel on device number `device`. Returns an empty string if that works and its arithmetic gives the processor's bits (no
/// contraction, no flushed subnormals, IEEE division and square root); otherwise the reason, as part of a sentence. Never throws. The
/// device stays current on the calling thread.
[[nodiscard]] std::string probe(int device);

}  // namespace dmoscope::gpu
