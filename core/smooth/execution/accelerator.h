#pragma once
// Accelerators: devices that smooth besides the CPU. core knows only this much of them; the program makes the one there is and hands it to
// the session.

#include <memory>
#include <string>
#include <string_view>

#include "core/smooth/smoother.h"

namespace dmoscope {

/// Backend that a run shall smooth on. Auto: an accelerator where there is one that can do what the run asks for, else the CPU.
enum class Backend { Auto, Cpu, Cuda };
/// Name on the command line: "auto", "cpu", "cuda".
[[nodiscard]] std::string_view name(Backend backend);
/// Reads a name. Throws UsageError that lists them.
[[nodiscard]] Backend parse_backend(std::string_view word);

/// Device that runs DMO. Any thread may use it.
class Accelerator {
 public:
  Accelerator() = default;
  Accelerator(const Accelerator&) = delete;
  Accelerator& operator=(const Accelerator&) = delete;
  virtual ~Accelerator() = default;
  /// Backend that the device belongs to.
  [[nodiscard]] virtual Backend backend() const noexcept { return Backend::Cuda; }
  /// Description for a person: "NVIDIA H200, compute capability 9.0, 139 GiB".
  [[nodiscard]] virtual std::string description() const = 0;
  /// Number of the device in its runtime, by which OpenGL's interfaces know it.
  [[nodiscard]] virtual int number() const noexcept { return 0; }
  /// Makes DMO on this device, for planar meshes in float, for volumes in either precision, for two aims in double, by the contract of
  /// make_smoother, which also checks the task. Its `immovable` is needed for Smoother::statistics() and only read here. Throws
  /// DeviceError, which for memory says how much was asked for and how much is free.
  [[nodiscard]] virtual std::unique_ptr<Smoother> make_dmo(const SmoothingTask& task) const = 0;
};

/// Accelerator of this machine, or the reason why there is none.
struct Acceleration {
  std::shared_ptr<const Accelerator> accelerator{};
  std::string reason = "no device was looked for";  // reason where there is none
};

}  // namespace dmoscope
