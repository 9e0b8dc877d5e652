#pragma once
// Ways of EGL to OpenGL without a window that are tried, in order. No EGL. Only for sources of this module.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dmoscope::render {

/// Facts that EGL tells about a device before it is used.
struct EglDevice {
  std::optional<int> cuda{};  // CUDA's number of the device
  bool software = false;      // Mesa's software rasteriser
};

/// A way to a context: the surfaceless platform, or a device of the device platform.
struct EglWay {
  std::optional<std::size_t> device;  // none: surfaceless
  std::string description;            // "EGL device 0 (CUDA device 0)"
};

/// Ways to a context in the order in which they are to be tried. `forced`: the value of the variable DMOSCOPE_EGL, "surfaceless",
/// "device:N" or "cuda:N", which leaves one way alone; empty: the device that is CUDA device `cuda_device` if there is one, then
/// surfaceless (Mesa), then the devices in EGL's order. Throws UsageError that says what there is when nothing matches `forced`.
[[nodiscard]] std::vector<EglWay> egl_order(std::span<const EglDevice> devices, std::string_view forced, std::optional<int> cuda_device);

}  // namespace dmoscope::render
