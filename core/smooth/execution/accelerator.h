#pragma once
// Who can smooth besides the CPU. core knows only this much of it; the program makes the one there is and hands it to the session.

#include <memory>
#include <string>
#include <string_view>

#include "core/smooth/smoother.h"

namespace dmoscope {

/// What a run shall smooth on. Auto: an accelerator where there is one that can do what the run asks for, else the CPU.
enum class Backend { Auto, Cpu, Cuda };
/// "auto", "cpu", "cuda".
[[nodiscard]] std::string_view name(Backend backend);
/// The reverse. Throws UsageError that lists them.
[[nodiscard]] Backend parse_backend(std::string_view word);

/// A device that runs DMO. Any thread may use it.
class Accelerator {
 public:
  Accelerator() = default;
  Accelerator(const Accelerator&) = delete;
  Accelerator& operator=(const Accelerator&) = delete;
  virtual ~Accelerator() = default;
  /// Which backend it is.
  [[nodiscard]] virtual Backend backend() const noexcept { return Backend::Cuda; }
  /// "NVIDIA H200, compute capability 9.0, 139 GiB"
  [[nodiscard]] virtual std::string description() const = 0;
  /// The runtime's number of the device, by which OpenGL's interfaces know it.
  [[nodiscard]] virtual int number() const noexcept { return 0; }
  /// DMO on this device, of planar meshes in float, of volumes in either precision, of two aims in double; the same contract as
  /// make_smoother's, which also checks the task. Its `immovable` is needed for Smoother::statistics() and only read here. Throws
  /// DeviceError, which for memory says how much was asked for and how much is free.
  [[nodiscard]] virtual std::unique_ptr<Smoother> make_dmo(const SmoothingTask& task) const = 0;
};

/// The accelerator of this machine, or why there is none.
struct Acceleration {
  std::shared_ptr<const Accelerator> accelerator{};
  std::string reason = "no device was looked for";  // where there is none
};

}  // namespace dmoscope
