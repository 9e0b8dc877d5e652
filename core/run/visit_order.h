#pragma once
// In which order an iteration visits the free vertices (before colouring).

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dmoscope {

struct VisitOrder {
  std::optional<std::uint64_t> seed;  // none: natural; else shuffled with this seed
  friend bool operator==(const VisitOrder&, const VisitOrder&) = default;
};

/// "natural" or "shuffle:SEED".
[[nodiscard]] std::string to_text(const VisitOrder& order);
/// Throws UsageError.
[[nodiscard]] VisitOrder parse_order(std::string_view word);

}  // namespace dmoscope
