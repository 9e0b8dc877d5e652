#pragma once
// Who computes lets those go first who draw.

#include "core/base/thread_pool.h"

namespace dmoscope {

/// The calling thread, those of the pool, and all that they start later give way to the program's other threads where there are more than
/// processors (a lower priority; a thread cannot take it back). Where the system has no priorities of threads nothing happens.
void give_way(ThreadPool& pool);

}  // namespace dmoscope
