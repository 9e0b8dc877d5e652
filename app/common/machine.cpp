#include "app/common/machine.h"

#include <array>
#include <charconv>
#include <ctime>
#include <fstream>

#include "dmoscope_commit.h"

namespace dmoscope::app {
namespace {

/// The text after the colon of the first line of `file` that begins with `key`; none without such a line.
std::optional<std::string> value_of(const char* file, std::string_view key) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with(key)) continue;
    const auto colon = line.find(':');
    const auto start = line.find_first_not_of(" \t", colon == std::string::npos ? line.size() : colon + 1);
    if (start != std::string::npos) return line.substr(start);
  }
  return std::nullopt;
}

std::optional<std::uint64_t> memory(std::string_view key) {
  const std::optional<std::string> text = value_of("/proc/meminfo", key);
  if (!text) return std::nullopt;
  std::uint64_t kibibytes = 0;
  if (std::from_chars(text->data(), text->data() + text->size(), kibibytes).ec != std::errc{}) return std::nullopt;
  return kibibytes * 1024;
}

}  // namespace

std::string_view compiler() {
#if defined(__clang__)
  constexpr std::string_view kText = "clang " __clang_version__;  // may end in a blank
  return kText.substr(0, kText.find_last_not_of(' ') + 1);
#else
  return "g++ " __VERSION__;
#endif
}

std::string_view compiler_flags() { return DMOSCOPE_FLAGS; }

std::string_view commit() { return DMOSCOPE_COMMIT; }

std::string processor() { return value_of("/proc/cpuinfo", "model name").value_or("unknown"); }

std::optional<std::uint64_t> total_memory() { return memory("MemTotal"); }

std::optional<std::uint64_t> available_memory() { return memory("MemAvailable"); }

std::string date_and_time() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  const std::size_t length = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return {text.data(), length};
}

}  // namespace dmoscope::app
