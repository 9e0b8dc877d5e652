#pragma once
// Checks that several verbs' options share.

#include <string>

#include <CLI/CLI.hpp>

namespace dmoscope::app {

/// For counts: the parser itself would turn -1 into the largest number there is.
[[nodiscard]] inline CLI::Validator not_negative() {
  return CLI::Validator(
      [](const std::string& word) { return word.starts_with('-') ? "must be a whole number, at least 0" : std::string(); }, "");
}

}  // namespace dmoscope::app
