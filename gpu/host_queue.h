#pragma once
// The host in the place of a device: runs the kernels' bodies lane by lane, so that everything built on a Queue can be tested without a
// GPU. Not a backend for users: the processor's own lanes are far faster.

#include <memory>

#include "core/base/thread_pool.h"
#include "gpu/queue.h"

namespace dmoscope::gpu {

/// Properties and failures of the device that a test simulates.
struct HostDevice {
  ThreadPool* pool = nullptr;                  // shares the lanes of a launch among its threads; null: one lane after the other
  std::size_t memory = std::size_t{1} << 40U;  // bytes; a request for more is refused, as by a device
  std::size_t lanes_at_once = 4096;
};

/// Queue of the host. After lose_after(n), the n-th launch from then on and all later calls fail, as on a device that was lost.
class HostQueue : public Queue {
 public:
  virtual void lose_after(std::size_t launches) = 0;
};

[[nodiscard]] std::shared_ptr<HostQueue> make_host_queue(const HostDevice& device);

}  // namespace dmoscope::gpu
