#include "app/common/hints.h"

#include <algorithm>
#include <array>

#include "core/base/unknown_value.h"

namespace dmoscope::app {

Hints parse_hints(std::string_view word) {
  constexpr std::array<std::string_view, 3> kWords{"on", "full", "off"};  // in the order of Hints
  const auto found = std::ranges::find(kWords, word);
  if (found == kWords.end()) throw UsageError("--hints: " + unknown_value("choice", word, kWords));
  return static_cast<Hints>(found - kWords.begin());
}

}  // namespace dmoscope::app
