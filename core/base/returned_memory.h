#pragma once
// Return of freed memory to the system.

namespace dmoscope {

/// Makes the C library return memory of large arrays to the system as soon as it is freed, by whichever thread; for programs that run long.
/// Otherwise it keeps the memory for the next allocation of the same thread.
void return_large_memory() noexcept;

}  // namespace dmoscope
