#pragma once
// zlib (RFC 1950) for blocks of known size.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dmoscope {

/// Appends the `size` bytes that `packed` unpacks to. False, with `out` as it was, when it unpacks to anything else; nothing is allocated
/// for sizes that so few bytes cannot unpack to.
[[nodiscard]] bool zlib_unpack(std::string_view packed, std::size_t size, std::vector<char>& out);

[[nodiscard]] std::string zlib_packed(std::string_view bytes);

}  // namespace dmoscope
