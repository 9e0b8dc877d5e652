#pragma once
// Amounts of memory as people write them.

#include <cstdint>
#include <string_view>

namespace dmoscope {

/// Parses a number of bytes, at least 1: "500000000", "500M", "2G", with a letter KiB, MiB, GiB, TiB (of either case, "B" or "iB" may
/// follow). Throws UsageError.
[[nodiscard]] std::uint64_t parse_byte_size(std::string_view word);

}  // namespace dmoscope
