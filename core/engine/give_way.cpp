#include "core/engine/give_way.h"

#ifdef __linux__
#include <barrier>

#include <sys/resource.h>
#endif

namespace dmoscope {

void give_way(ThreadPool& pool) {
#ifdef __linux__
  constexpr int kBehind = 3;  // half the share of a thread that does not give way
  // As many pieces as threads, none of which ends before the last has begun: each thread gets one.
  const auto threads = static_cast<std::ptrdiff_t>(pool.size());
  std::barrier all_there(threads);
  pool.parallel_for(pool.size(), 1, [&](std::size_t, std::size_t) {
    all_there.arrive_and_wait();
    (void)::setpriority(PRIO_PROCESS, 0, kBehind);  // of Linux: the calling thread's
  });
#else
  (void)pool;
#endif
}

}  // namespace dmoscope
