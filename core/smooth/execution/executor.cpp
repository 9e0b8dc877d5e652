#include "core/smooth/execution/executor.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/unknown_value.h"
#include "core/quality/metric_phrase.h"
#include "core/smooth/execution/choose_executor.h"
#include "core/smooth/execution/method_table.h"
#include "core/smooth/place_aim.h"

namespace dmoscope {

namespace {

constexpr std::array<std::string_view, 3> kBackendNames{"auto", "cpu", "cuda"};  // in the order of Backend

[[noreturn]] void refuse(const std::string& why) { throw UsageError(fmt::format("the cuda backend cannot be used: {}", why)); }

/// Reason why no accelerator does metrics that are defined by formulas or targets; empty when one can.
std::string obstacle_of_defined(const SmoothingTask& task) {
  const auto* second = task.combination ? std::get_if<Metric>(&task.combination->second) : nullptr;
  const bool of_defined = !is_built_in(task.metric);
  if ((second != nullptr && !is_built_in(*second)) || (of_defined && (task.combination || task.then_mean)))
    return "formulas and targets are joined with another aim on the CPU alone";
  return {};
}

/// Reason why no accelerator does the task; empty when one can.
std::string obstacle(const Acceleration& acceleration, const SmoothingTask& task) {
  if (!method_info(task.method).accelerated) return fmt::format("{} runs on the CPU alone", task.method);
  if (const std::string why = obstacle_of_defined(task); !why.empty()) return why;
  if (task.combination && task.then_mean) return "a phase that raises the mean keeps two minima on the CPU alone";
  if (task.guard) return fmt::format("the guard on {} is kept on the CPU alone (guard off)", metric_phrase(task.guard->metric));
  if (task.slides || task.input->is_surface()) return "vertices slide on the CPU alone";
  if (task.aim && !task.aim->formula()) return "sizes out of a nodal field, or on the Earth, are looked up on the CPU alone";
  if (task.search.precision == Precision::Double && !task.input->is_volume() && !task.combination && is_built_in(task.metric))
    return "the search in double runs on the CPU alone";
  if (task.input->geometry.plane.period > 0.0) return "meshes that go round in longitude run on the CPU alone";
  if (task.search.simd) return "SIMD instructions were asked for, which are the CPU's";
  return acceleration.accelerator ? std::string() : acceleration.reason;
}

enum class OnCpu { Made, Later };  // when its smoother is made

Executor on_cpu(const SmoothingTask& task, OnCpu when, std::string reason) {
  return {when == OnCpu::Made ? make_smoother(task) : nullptr, Backend::Cpu, std::move(reason), {}};
}

Executor on_device(const Accelerator& accelerator, const SmoothingTask& task) {
  auto smoother = accelerator.make_dmo(task);
  std::string where = accelerator.description();
  if (const std::string how = smoother->description(); !how.empty()) where += "; " + how;
  return {std::move(smoother), accelerator.backend(), std::move(where), {}};
}

}  // namespace

std::string_view name(Backend backend) { return kBackendNames[static_cast<std::size_t>(backend)]; }

Backend parse_backend(std::string_view word) { return parse_choice<Backend>("backend", word, kBackendNames); }

void require_backend(Backend wanted, const Acceleration& acceleration) {
  if (wanted == Backend::Cuda && !acceleration.accelerator) refuse(acceleration.reason);
}

void require_executable(Backend wanted, const Acceleration& acceleration, const SmoothingTask& task) {
  require_possible(task);
  if (wanted != Backend::Cuda) return;
  if (const std::string why_not = obstacle(acceleration, task); !why_not.empty()) refuse(why_not);
}

namespace {

Executor after_failure(const std::string& why, const SmoothingTask& task, OnCpu when) {
  Executor executor = on_cpu(task, when, why);
  executor.warning = fmt::format("{}; smoothing on the CPU", why);
  return executor;
}

Executor executor_for(Backend wanted, const Acceleration& acceleration, const SmoothingTask& task, OnCpu when) {
  require_executable(wanted, acceleration, task);
  if (wanted == Backend::Cpu) return on_cpu(task, when, {});
  if (wanted == Backend::Cuda) return on_device(*acceleration.accelerator, task);
  const std::string why_not = obstacle(acceleration, task);
  if (!why_not.empty()) return on_cpu(task, when, fmt::format("no {}: {}", name(Backend::Cuda), why_not));
  try {
    return on_device(*acceleration.accelerator, task);
  } catch (const DeviceError& error) {
    return after_failure(fmt::format("{} failed: {}", name(acceleration.accelerator->backend()), error.what()), task, when);
  }
}

}  // namespace

Executor make_executor(Backend wanted, const Acceleration& acceleration, const SmoothingTask& task) {
  return executor_for(wanted, acceleration, task, OnCpu::Made);
}

Executor choose_executor(Backend wanted, const Acceleration& acceleration, const SmoothingTask& task) {
  return executor_for(wanted, acceleration, task, OnCpu::Later);
}

Executor executor_after_failure(const std::string& why, const SmoothingTask& task) { return after_failure(why, task, OnCpu::Made); }

}  // namespace dmoscope
