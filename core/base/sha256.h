#pragma once
// SHA-256 (FIPS 180-4), by which others can tell that a file is the very one.

#include <string>
#include <string_view>

namespace dmoscope {

/// Of these bytes, 64 lower-case hexadecimal digits: what `sha256sum` prints.
[[nodiscard]] std::string sha256(std::string_view bytes);

}  // namespace dmoscope
