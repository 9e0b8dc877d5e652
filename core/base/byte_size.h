#pragma once
// Amounts of memory as people write them.

#include <cstdint>
#include <string_view>

namespace dmoscope {

/// "500000000", "500M", "2G": bytes, or KiB, MiB, GiB, TiB with a letter (of either case, "B" or "iB" may follow); at least 1. Throws
/// UsageError.
[[nodiscard]] std::uint64_t parse_byte_size(std::string_view word);

}  // namespace dmoscope
