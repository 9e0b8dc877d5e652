#pragma once
// CUDA devices of this machine, and the reason if none is usable.

#include <cstddef>
#include <string>
#include <vector>

namespace dmoscope::gpu {

struct Device {
  std::string name{};
  int major = 0, minor = 0;  // compute capability
  std::size_t memory = 0;    // bytes
  std::string problem{};     // reason why it cannot run this program's kernels; empty if it can, or was not tried
};

struct Availability {
  bool built = false;           // whether the program was built with a CUDA toolkit
  std::vector<Device> devices;  // in the order of their numbers
  int best = -1;                // the usable device with the most memory
  std::string reason;           // reason why the cuda backend cannot be used; empty if it can
};

/// Asks the driver, and tries the devices from the one with the most memory on until one is usable (some 0.2 s each). Never throws; a
/// machine without a driver gives a reason.
[[nodiscard]] Availability availability();

}  // namespace dmoscope::gpu
