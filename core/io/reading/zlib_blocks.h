#pragma once
// Packing and unpacking of zlib blocks (RFC 1950) of known size.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dmoscope {

/// Appends the `size` bytes that `packed` unpacks to. False, with `out` unchanged, if it unpacks to any other size; allocates nothing for
/// sizes that so few bytes cannot unpack to.
[[nodiscard]] bool zlib_unpack(std::string_view packed, std::size_t size, std::vector<char>& out);

[[nodiscard]] std::string zlib_packed(std::string_view bytes);

}  // namespace dmoscope
