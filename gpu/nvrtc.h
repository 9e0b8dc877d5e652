#pragma once
// The CUDA compiler as a library, NVRTC, which is part of CUDA's toolkit, not of the driver. Optional at run time.

#include <limits>
#include <memory>
#include <span>
#include <string>

#include "gpu/defined/formula_source.h"

namespace dmoscope::gpu {

class Nvrtc {
 public:
  /// Finds the newest library up to version `newest` (13000: 13.0), the driver's version: it refuses the output of a newer compiler. Null
  /// if there is none whose functions are known. Searched for once; any thread may ask.
  [[nodiscard]] static const Nvrtc* find(int newest = std::numeric_limits<int>::max());

  Nvrtc(const Nvrtc&) = delete;
  Nvrtc& operator=(const Nvrtc&) = delete;
  ~Nvrtc();

  /// Name and version: "NVRTC 13.0".
  [[nodiscard]] const std::string& description() const noexcept { return description_; }
  /// Compiles a source to PTX for GPUs from a compute capability on (75: 7.5), or from the next lower one that the library knows. Its
  /// results have the processor's bits. Any thread may call it. Throws DeviceError with the compiler's messages.
  [[nodiscard]] std::string compile(const std::string& source, std::span<const SourceHeader> headers, int capability) const;

 private:
  class Library;
  explicit Nvrtc(std::unique_ptr<Library> library);
  std::unique_ptr<Library> library_;
  int version_ = 0;
  std::string description_;
};

}  // namespace dmoscope::gpu
