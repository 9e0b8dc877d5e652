#pragma once
// Output of `dmoscope info FILE`: the content of a mesh file.

#include <filesystem>

namespace dmoscope::app {

/// Prints the file's elements, groups, data and interfaces; with `json` as one JSON object. Throws the errors of reading.
void tell_mesh(const std::filesystem::path& file, bool json);

}  // namespace dmoscope::app
