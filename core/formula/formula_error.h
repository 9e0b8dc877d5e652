#pragma once
// Errors in formulas, with their place.

#include <cstddef>
#include <string>

#include "core/base/error.h"

namespace dmoscope {

/// A place in a formula's text, from 1; columns count letters, not bytes.
struct FormulaPlace {
  std::size_t line = 1, column = 1;
  friend bool operator==(const FormulaPlace&, const FormulaPlace&) = default;
};

/// A formula that cannot be parsed or makes no sense. what() is "formula, column 7: reason", with "line 2, " if there are several lines.
class FormulaError : public UsageError {
 public:
  FormulaError(FormulaPlace place, const std::string& what);
  [[nodiscard]] FormulaPlace place() const noexcept { return place_; }
  /// The message without the place.
  [[nodiscard]] const std::string& reason() const noexcept { return reason_; }

 private:
  FormulaPlace place_;
  std::string reason_;
};

}  // namespace dmoscope
