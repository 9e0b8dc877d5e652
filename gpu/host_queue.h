#pragma once
// The host in the place of a device: runs the kernels' bodies lane by lane, so that everything built on a Queue can be tested without a
// GPU. No backend for users: the processor's own lanes are far faster.

#include <memory>

#include "core/base/thread_pool.h"
#include "gpu/queue.h"

namespace dmoscope::gpu {

/// What a test may have go wrong.
struct HostDevice {
  ThreadPool* pool = nullptr;                  // the lanes of a launch are shared among its threads; null: one after the other
  std::size_t memory = std::size_t{1} << 40U;  // bytes; more is refused as a device out of memory refuses it
  std::size_t lanes_at_once = 4096;
};

/// With lose_after(n), the n-th launch from then on and all that follows fails as on a device that was lost.
class HostQueue : public Queue {
 public:
  virtual void lose_after(std::size_t launches) = 0;
};

[[nodiscard]] std::shared_ptr<HostQueue> make_host_queue(const HostDevice& device);

}  // namespace dmoscope::gpu
