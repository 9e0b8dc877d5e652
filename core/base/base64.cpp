#include "core/base/base64.h"

#include <algorithm>
#include <array>

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

bool Base64Reader::next_group() {
  std::uint32_t group = 0;
  std::size_t digits = 0;  // number of digits in the group that are no padding
  for (std::size_t k = 0; k < 4; ++k) {
    while (at_ < text_.size() && (text_[at_] == ' ' || (text_[at_] >= '\t' && text_[at_] <= '\r'))) ++at_;
    if (at_ == text_.size()) return false;
    const char c = text_[at_++];
    const std::uint8_t value = kValues[static_cast<unsigned char>(c)];
    if (c == '=' ? k < 2 : (value == kNoDigit || digits != k)) return false;
    if (c != '=') ++digits;
    group = group << 6U | (c == '=' ? 0U : value);
  }
  for (std::size_t k = 0; k < 3; ++k) group_[k] = static_cast<char>(static_cast<std::uint8_t>(group >> (16U - 8U * k)));
  count_ = digits - 1;
  used_ = 0;
  return true;
}

bool Base64Reader::read(std::size_t count, std::vector<char>& out) {
  const std::size_t before = out.size();
  if (count > (text_.size() - at_) / 4 * 3 + (count_ - used_)) return false;
  out.reserve(before + count);
  while (out.size() < before + count) {
    if (used_ == count_ && !next_group()) {
      out.resize(before);
      return false;
    }
    for (; used_ < count_ && out.size() < before + count; ++used_) out.push_back(group_[used_]);
  }
  return true;
}

}  // namespace dmoscope
