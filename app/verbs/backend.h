#pragma once
// The --backend option: which one a verb may use.

#include <string>
#include <string_view>

namespace dmoscope::app {

/// Name of the backend that "auto", "cpu" or "cuda" stands for here. Throws UsageError with the reason when it cannot be used.
[[nodiscard]] std::string choose_backend(std::string_view wanted);

}  // namespace dmoscope::app
