#include "core/run/run_task.h"

#include <utility>

#include "core/base/error.h"
#include "core/smooth/execution/executor.h"

namespace dmoscope {

SmoothingTask task_of(std::shared_ptr<const InputMesh> input, const RunParameters& parameters) {
  SmoothingTask task;
  task.method = parameters.method;
  task.input = std::move(input);
  task.metric = parameters.metric;
  task.search = parameters.search;
  task.options = parameters.options;
  task.combination = parameters.combination;
  task.then_joint = parameters.then_joint.has_value();
  task.then_mean = parameters.then_mean.has_value();
  task.slides = lets_slide(*task.input, parameters.standing());
  task.max_deviation = parameters.max_deviation * task.input->geometry.size;
  return task;
}

std::string why_no_run(std::shared_ptr<const InputMesh> input, const RunParameters& parameters, const Acceleration& acceleration) {
  try {
    require_executable(parameters.backend, acceleration, task_of(std::move(input), parameters));
    return {};
  } catch (const UsageError& error) {
    return error.what();
  }
}

}  // namespace dmoscope
