#pragma once
// Names that the user gives to runs.

#include <string_view>

namespace dmoscope {

/// Throws UsageError for a name that is too long for lists and titles, has several lines, or is no UTF-8. An empty one is valid: it removes
/// the name.
void require_run_name(std::string_view name);

}  // namespace dmoscope
