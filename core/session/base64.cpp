#include "core/session/base64.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace dmoscope {

namespace {

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint8_t kNoDigit = 255;

constexpr std::array<std::uint8_t, 256> kValues = [] {
  std::array<std::uint8_t, 256> values{};
  values.fill(kNoDigit);
  for (std::size_t i = 0; i < kDigits.size(); ++i) values[static_cast<unsigned char>(kDigits[i])] = static_cast<std::uint8_t>(i);
  return values;
}();

}  // namespace

std::string to_base64(std::span<const std::uint8_t> bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8U | (k < count ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[group >> (18U - 6U * k) & 63U] : '=';
  }
  return text;
}

std::optional<std::vector<std::uint8_t>> from_base64(std::string_view text) {
  if (text.size() % 4 != 0) return std::nullopt;
  std::size_t padding = 0;
  while (padding < 2 && padding < text.size() && text[text.size() - 1 - padding] == '=') ++padding;
  std::vector<std::uint8_t> bytes;
  bytes.reserve(text.size() / 4 * 3);
  for (std::size_t i = 0; i < text.size(); i += 4) {
    const std::size_t digits = i + 4 == text.size() ? 4 - padding : 4;
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint8_t value = k < digits ? kValues[static_cast<unsigned char>(text[i + k])] : std::uint8_t{0};
      if (value == kNoDigit) return std::nullopt;
      group = group << 6U | value;
    }
    for (std::size_t k = 0; k + 1 < digits; ++k) bytes.push_back(static_cast<std::uint8_t>(group >> (16U - 8U * k)));
  }
  return bytes;
}

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
