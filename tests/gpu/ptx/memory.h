#pragma once
// Memory that kernels may access.

#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>

namespace dmoscope::gpu::ptx {

/// An invalid operation of an instruction; the caller adds which instruction it was.
class Fault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A piece of memory; addresses are the host's own.
struct Extent {
  std::uintptr_t begin = 0;
  std::size_t bytes = 0;
  [[nodiscard]] bool holds(std::uintptr_t address, std::size_t size) const noexcept {
    return address >= begin && address - begin <= bytes && size <= bytes - (address - begin);
  }
};

/// A device's global memory: exactly the allocated bytes.
class GlobalMemory {
 public:
  void add(const void* memory, std::size_t bytes) { sizes_[reinterpret_cast<std::uintptr_t>(memory)] = bytes; }
  /// Removes a piece and returns its size.
  std::size_t remove(const void* memory) {
    const auto found = sizes_.find(reinterpret_cast<std::uintptr_t>(memory));
    if (found == sizes_.end()) throw Fault("memory is released that was not allocated");
    const std::size_t bytes = found->second;
    sizes_.erase(found);
    return bytes;
  }
  [[nodiscard]] bool holds(std::uintptr_t address, std::size_t size) const {
    auto after = sizes_.upper_bound(address);
    if (after == sizes_.begin()) return false;
    --after;
    return Extent{after->first, after->second}.holds(address, size);
  }

 private:
  std::map<std::uintptr_t, std::size_t> sizes_;
};

}  // namespace dmoscope::gpu::ptx
