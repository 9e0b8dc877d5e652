#include "core/session/position_text.h"

#include <bit>
#include <cmath>
#include <cstdint>

namespace dmoscope {

std::string pack_positions(std::span<const Vec3> positions) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(positions.size() * 24);
  for (const Vec3& p : positions) {
    for (const double coordinate : {p.x, p.y, p.z}) {
      const auto bits = std::bit_cast<std::uint64_t>(coordinate);
      for (unsigned k = 0; k < 8; ++k) bytes.push_back(static_cast<std::uint8_t>(bits >> 8U * k));
    }
  }
  return to_base64(bytes);
}

std::optional<std::vector<Vec3>> unpack_positions(std::string_view text, std::size_t count) {
  const auto bytes = from_base64(text);
  if (!bytes || bytes->size() != count * 24) return std::nullopt;
  const auto coordinate = [&](std::size_t i) {
    std::uint64_t bits = 0;
    for (unsigned k = 0; k < 8; ++k) bits |= static_cast<std::uint64_t>((*bytes)[8 * i + k]) << 8U * k;
    return std::bit_cast<double>(bits);
  };
  std::vector<Vec3> positions(count);
  for (std::size_t v = 0; v < count; ++v) {
    positions[v] = {coordinate(3 * v), coordinate(3 * v + 1), coordinate(3 * v + 2)};
    const Vec3& p = positions[v];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return std::nullopt;
  }
  return positions;
}

}  // namespace dmoscope
