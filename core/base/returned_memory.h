#pragma once
// What becomes of memory that is freed.

namespace dmoscope {

/// Memory of large arrays goes back to the system at once when it is freed, whichever thread frees it; for programs that run long. Else
/// the C library keeps what it was given back to serve the next allocation of the same thread with it.
void return_large_memory() noexcept;

}  // namespace dmoscope
