#pragma once
// SHA-256 (FIPS 180-4), which proves that two files are equal.

#include <string>
#include <string_view>

namespace dmoscope {

/// The SHA-256 hash of these bytes as 64 lower-case hexadecimal digits, as `sha256sum` prints it.
[[nodiscard]] std::string sha256(std::string_view bytes);

}  // namespace dmoscope
