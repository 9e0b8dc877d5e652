#pragma once
// What `dmoscope info FILE` tells: what is in a mesh file.

#include <filesystem>

namespace dmoscope::app {

/// Prints the file's elements, groups, data and interfaces; as one JSON object where `json`. Throws what reading throws.
void tell_mesh(const std::filesystem::path& file, bool json);

}  // namespace dmoscope::app
