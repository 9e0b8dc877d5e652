#pragma once
// The CUDA compiler that a program can call, NVRTC, where its library is: it is part of CUDA's toolkit, not of the driver. Nothing needs
// it.

#include <limits>
#include <memory>
#include <span>
#include <string>

#include "gpu/defined/formula_source.h"

namespace dmoscope::gpu {

class Nvrtc {
 public:
  /// Not newer than `newest` (13000: 13.0), which a driver says of itself: it refuses what a newer compiler makes. Null where there is no
  /// such library, or none whose functions are known. Looked for once; any thread may ask.
  [[nodiscard]] static const Nvrtc* find(int newest = std::numeric_limits<int>::max());

  Nvrtc(const Nvrtc&) = delete;
  Nvrtc& operator=(const Nvrtc&) = delete;
  ~Nvrtc();

  /// "NVRTC 13.0"
  [[nodiscard]] const std::string& description() const noexcept { return description_; }
  /// PTX of a source, for GPUs from a compute capability on (75: 7.5), or from the next lower one that it knows. What it
  /// computes has the processor's bits. Any thread may call it. Throws DeviceError with what the compiler says.
  [[nodiscard]] std::string compile(const std::string& source, std::span<const SourceHeader> headers, int capability) const;

 private:
  class Library;
  explicit Nvrtc(std::unique_ptr<Library> library);
  std::unique_ptr<Library> library_;
  int version_ = 0;
  std::string description_;
};

}  // namespace dmoscope::gpu
