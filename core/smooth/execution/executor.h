#pragma once
// Executor: the backend that does a run's smoothing, and why.

#include <memory>
#include <string>

#include "core/smooth/execution/accelerator.h"

namespace dmoscope {

/// Smoother and its backend.
struct Executor {
  std::unique_ptr<Smoother> smoother;
  Backend backend = Backend::Cpu;  // never Auto
  std::string reason;              // for an accelerator its description; for cpu why no accelerator, empty where none was wanted
  std::string warning;             // a sentence for a person where an accelerator should have been used and failed; usually empty
};

/// Throws UsageError with the reason when `wanted` names a backend that is not there.
void require_backend(Backend wanted, const Acceleration& acceleration);

/// Throws the UsageError that make_executor would throw. Reads only `input` of the task's pointers.
void require_executable(Backend wanted, const Acceleration& acceleration, const SmoothingTask& task);

/// Makes the executor of a task. Throws UsageError as make_smoother does, and with the reason when `wanted` is impossible; DeviceError when
/// `wanted` fails. For Backend::Auto a device's failure is no error: the CPU does the work, with a warning.
[[nodiscard]] Executor make_executor(Backend wanted, const Acceleration& acceleration, const SmoothingTask& task);

/// Executor on the CPU after an accelerator failed; `why`: its error.
[[nodiscard]] Executor executor_after_failure(const std::string& why, const SmoothingTask& task);

}  // namespace dmoscope
