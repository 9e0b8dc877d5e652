#pragma once
// Streams and events of the CUDA runtime, destroyed with their owner. Needs a CUDA toolkit.

#include <cuda_runtime_api.h>

#include "gpu/cuda_error.h"
#include "gpu/queue.h"

namespace dmoscope::gpu {

/// Directs the calling thread's CUDA calls to a device; each thread has its own.
inline void use(int device) { DMOSCOPE_CUDA_CHECK(cudaSetDevice(device)); }

class CudaStream {
 public:
  CudaStream(int device, Urgency urgency) {
    use(device);
    int last = 0, first = 0;
    DMOSCOPE_CUDA_CHECK(cudaDeviceGetStreamPriorityRange(&last, &first));
    DMOSCOPE_CUDA_CHECK(cudaStreamCreateWithPriority(&stream_, cudaStreamNonBlocking, urgency == Urgency::First ? first : last));
  }
  ~CudaStream() { (void)cudaStreamDestroy(stream_); }
  CudaStream(const CudaStream&) = delete;
  CudaStream& operator=(const CudaStream&) = delete;
  [[nodiscard]] cudaStream_t get() const noexcept { return stream_; }

 private:
  cudaStream_t stream_ = nullptr;
};

/// Event of the current device.
class CudaEvent {
 public:
  CudaEvent() { DMOSCOPE_CUDA_CHECK(cudaEventCreateWithFlags(&event_, cudaEventDisableTiming)); }
  ~CudaEvent() { (void)cudaEventDestroy(event_); }
  CudaEvent(const CudaEvent&) = delete;
  CudaEvent& operator=(const CudaEvent&) = delete;
  void record(cudaStream_t stream) const { DMOSCOPE_CUDA_CHECK(cudaEventRecord(event_, stream)); }
  /// Waits until all work before the last record() is done; returns at once if nothing was recorded.
  void wait() const { DMOSCOPE_CUDA_CHECK(cudaEventSynchronize(event_)); }
  [[nodiscard]] cudaEvent_t get() const noexcept { return event_; }

 private:
  cudaEvent_t event_ = nullptr;
};

}  // namespace dmoscope::gpu
