#include "core/engine/give_way.h"

#ifdef __linux__
#include <barrier>

#include <sys/resource.h>
#endif

namespace dmoscope {

void give_way(ThreadPool& pool) {
#ifdef __linux__
  constexpr int kBehind = 3;  // nice value, which gives a thread half the share of others
  // Gives each thread one piece: as many pieces as threads, none of which ends before the last has begun.
  const auto threads = static_cast<std::ptrdiff_t>(pool.size());
  std::barrier all_there(threads);
  pool.parallel_for(pool.size(), 1, [&](std::size_t, std::size_t) {
    all_there.arrive_and_wait();
    (void)::setpriority(PRIO_PROCESS, 0, kBehind);  // affects only the calling thread in Linux
  });
#else
  (void)pool;
#endif
}

}  // namespace dmoscope
