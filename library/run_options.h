#pragma once
// Options as words, and the run that they describe.

#include <string>
#include <vector>

#include "core/input/input_mesh.h"
#include "core/run/parameters.h"
#include "core/run/run.h"
#include "library/include/dmoscope/smooth.h"

namespace dmo {

struct RunRequest {
  dmoscope::RunParameters parameters;
  dmoscope::ConvergenceLimits limits;
  bool until_converged = false;
  std::vector<std::string> warnings;
};

/// Makes the run's request from the options. Throws dmoscope::UsageError that names the option.
[[nodiscard]] RunRequest request_of(const dmoscope::InputMesh& input, const SmoothOptions& options);

}  // namespace dmo
