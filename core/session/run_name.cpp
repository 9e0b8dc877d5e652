#include "core/session/run_name.h"

#include <cstdint>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/utf8.h"

namespace dmoscope {

void require_run_name(std::string_view name) {
  constexpr std::size_t kMostLetters = 60;
  std::size_t letters = 0;
  for (std::size_t at = 0; at < name.size(); ++letters) {
    std::uint32_t code = 0;
    const std::size_t size = utf8_letter(name.substr(at), code);
    if (size == 0) throw UsageError("a run's name is expected as UTF-8 text");
    if (code < 0x20 || code == 0x7F) throw UsageError("a run's name is one line, without tabs");
    at += size;
  }
  if (letters > kMostLetters) throw UsageError(fmt::format("a run's name has at most {} letters, not {}", kMostLetters, letters));
  if (!name.empty() && name.find_first_not_of(' ') == std::string_view::npos) throw UsageError("a run's name is more than spaces");
}

}  // namespace dmoscope
