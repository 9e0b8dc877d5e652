#pragma once
// Checks of options that several subcommands share.

#include <charconv>
#include <cstdint>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace dmoscope::app {

/// Makes a transform for counts: a whole number from `least` to `most` in plain digits. The parser alone would turn -1 into the largest
/// number, read 010 as 8, and wrap numbers that are too large.
[[nodiscard]] inline CLI::Validator whole_number(std::uint64_t least, std::uint64_t most) {
  return CLI::Validator(
      [least, most](std::string& word) {
        std::uint64_t value = 0;
        const char* end = word.data() + word.size();
        const auto [stop, error] = std::from_chars(word.data(), end, value);
        if (error != std::errc{} || stop != end || value < least || value > most) {
          return fmt::format("expected a whole number from {} to {}, not '{}'", least, most, word);
        }
        word = std::to_string(value);
        return std::string();
      },
      "");
}

}  // namespace dmoscope::app
