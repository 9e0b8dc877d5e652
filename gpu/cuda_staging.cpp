#ifdef DMOSCOPE_HAVE_CUDA

#include "gpu/cuda_staging.h"

#include <algorithm>
#include <cstring>

namespace dmoscope::gpu {

namespace {

/// Bytes that one thread copies at a time.
constexpr std::size_t kGrain = std::size_t{256} << 10U;

void copy(std::byte* to, const std::byte* from, std::size_t bytes, ThreadPool* pool) {
  for_chunks(pool, bytes, kGrain, [&](std::size_t first, std::size_t last) { std::memcpy(to + first, from + first, last - first); });
}

/// Runs `ask`, which asks for a copy and its mark; if it throws, waits for the work under way, since nothing would tell when the piece is
/// free.
template <class Ask>
void or_wait(cudaStream_t stream, const Ask& ask) {
  try {
    ask();
  } catch (...) {
    (void)cudaStreamSynchronize(stream);
    throw;
  }
}

}  // namespace

void CudaStaging::upload(cudaStream_t stream, void* to, const void* from, std::size_t bytes, ThreadPool* pool) {
  auto* const device = static_cast<std::byte*>(to);
  const auto* const host = static_cast<const std::byte*>(from);
  for (std::size_t at = 0, k = 0; at < bytes; at += kPieceBytes, ++k) {
    const Piece& piece = pieces_[k % pieces_.size()];
    const std::size_t length = std::min(kPieceBytes, bytes - at);
    piece.copied.wait();
    copy(piece.memory(), host + at, length, pool);
    or_wait(stream, [&] {
      DMOSCOPE_CUDA_CHECK(cudaMemcpyAsync(device + at, piece.memory(), length, cudaMemcpyHostToDevice, stream));
      piece.copied.record(stream);
    });
  }
}

void CudaStaging::download(cudaStream_t stream, void* to, const void* from, std::size_t bytes, ThreadPool* pool) {
  auto* const host = static_cast<std::byte*>(to);
  const auto* const device = static_cast<const std::byte*>(from);
  const std::size_t pieces = (bytes + kPieceBytes - 1) / kPieceBytes;
  const auto length = [&](std::size_t k) { return std::min(kPieceBytes, bytes - k * kPieceBytes); };
  const auto ask = [&](std::size_t k) {
    const Piece& piece = pieces_[k % pieces_.size()];
    or_wait(stream, [&] {
      DMOSCOPE_CUDA_CHECK(cudaMemcpyAsync(piece.memory(), device + k * kPieceBytes, length(k), cudaMemcpyDeviceToHost, stream));
      piece.copied.record(stream);
    });
  };
  for (std::size_t k = 0; k < std::min(pieces, pieces_.size()); ++k) ask(k);
  for (std::size_t k = 0; k < pieces; ++k) {
    const Piece& piece = pieces_[k % pieces_.size()];
    piece.copied.wait();
    copy(host + k * kPieceBytes, piece.memory(), length(k), pool);
    if (k + pieces_.size() < pieces) ask(k + pieces_.size());
  }
}

}  // namespace dmoscope::gpu

#endif
