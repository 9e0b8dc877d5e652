#pragma once
// Runs that options describe, and the words of options.

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/input/input_mesh.h"
#include "core/run/run.h"
#include "library/include/dmoscope/options.h"

namespace dmo {

struct RunRequest {
  std::shared_ptr<const dmoscope::InputMesh> input;  // the mesh as it is judged, on its reference surface
  dmoscope::RunParameters parameters;
  dmoscope::ConvergenceLimits limits;
  bool until_converged = false;
  std::vector<std::string> warnings;
};
/// Makes the request. Throws dmoscope::UsageError that begins with the option's name; Cancelled while the mesh is prepared.
[[nodiscard]] RunRequest request_of(const Mesh& mesh, const SmoothOptions& options, dmoscope::Progress& progress);

/// Sets the parameters of the program's table. Throws dmoscope::UsageError that begins with the option's name.
void set_parameters(dmoscope::RunParameters& parameters, const SmoothOptions& options);

/// Words in the order of Method, and of Recipe.
[[nodiscard]] std::vector<std::string_view> method_words();
[[nodiscard]] std::vector<std::string_view> recipe_words();
/// Word of an enumeration's value. Throws dmoscope::UsageError for a number that is none.
template <class Enum>
[[nodiscard]] std::string_view word_of(std::string_view option, Enum value, std::span<const std::string_view> words) {
  const auto number = static_cast<std::size_t>(value);
  if (number >= words.size()) throw dmoscope::UsageError(fmt::format("{}: there is no value {}", option, number));
  return words[number];
}

/// Does the work; puts the option's name before an error.
template <class Work>
auto naming(std::string_view option, const Work& work) {
  try {
    return work();
  } catch (const dmoscope::UsageError& error) {
    throw dmoscope::UsageError(fmt::format("{}: {}", option, error.what()));
  }
}

}  // namespace dmo
