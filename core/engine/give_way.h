#pragma once
// Priority of computing threads below that of drawing ones.

#include "core/base/thread_pool.h"

namespace dmoscope {

/// Lowers the priority of the calling thread, those of the pool, and all that they start later, so that they give way to the program's
/// other threads if there are too few processors. A thread cannot raise it again. Without effect if the system has no thread priorities.
void give_way(ThreadPool& pool);

}  // namespace dmoscope
