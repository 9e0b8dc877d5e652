#include "ui/toolkit/reading.h"

#include <filesystem>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "core/base/words.h"
#include "ui/toolkit/file_browser.h"

namespace dmoscope::ui {
namespace {

BeingRead of_file(const std::filesystem::path& path) {
  std::error_code unknown;
  const auto bytes = std::filesystem::file_size(path, unknown);
  const std::filesystem::path folder = std::filesystem::absolute(path, unknown).parent_path();
  return {path.filename().string(), unknown ? folder.string() : fmt::format("{} in {}", byte_size(bytes), folder.string())};
}

}  // namespace

std::optional<BeingRead> being_read(std::string_view command) {
  try {
    const std::vector<std::string> words = split_words(command);
    if (words.size() < 2) return std::nullopt;
    if (words[0] == "open" || words[0] == "open-state") return of_file(words[1]);
    if (words[0] == "generate") return BeingRead{"sample " + words[1], {}};
  } catch (const UsageError&) {  // a quote is not closed: the session reports it
  }
  return std::nullopt;
}

}  // namespace dmoscope::ui
