#pragma once
// Long copies between a device and ordinary memory, through memory that the device reaches itself. Needs a CUDA toolkit.

#include <array>
#include <cstddef>

#include <cuda_runtime_api.h>

#include "core/base/thread_pool.h"
#include "gpu/cuda_handles.h"

namespace dmoscope::gpu {

/// Copies through two pieces of such memory, in turn: while the device copies one, the host's threads copy the other. The runtime does the
/// same for ordinary memory, but with one thread of the host, which is slower than the bus. Copies are asked of the current device.
class CudaStaging {
 public:
  static constexpr std::size_t kPieceBytes = std::size_t{4} << 20U;
  /// Bytes from which on a copy is staged; shorter ones are left to the runtime.
  static constexpr std::size_t kWorthIt = std::size_t{1} << 20U;

  /// Copies from host to device; `from` may be changed on return. `pool` null: the calling thread copies alone. Throws CudaError.
  void upload(cudaStream_t stream, void* to, const void* from, std::size_t bytes, ThreadPool* pool);
  /// Copies from device to host, after all work of the stream so far; done on return. Throws CudaError.
  void download(cudaStream_t stream, void* to, const void* from, std::size_t bytes, ThreadPool* pool);

 private:
  /// Memory that the device may copy from or to until `copied`.
  class Piece {
   public:
    Piece() { DMOSCOPE_CUDA_CHECK(cudaMallocHost(&memory_, kPieceBytes)); }
    ~Piece() {
      (void)cudaEventSynchronize(copied.get());
      (void)cudaFreeHost(memory_);
    }
    Piece(const Piece&) = delete;
    Piece& operator=(const Piece&) = delete;
    [[nodiscard]] std::byte* memory() const noexcept { return static_cast<std::byte*>(memory_); }

    CudaEvent copied;

   private:
    void* memory_ = nullptr;
  };

  std::array<Piece, 2> pieces_;
};

}  // namespace dmoscope::gpu
