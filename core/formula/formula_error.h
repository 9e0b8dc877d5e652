#pragma once
// What is wrong with a formula, and where.

#include <cstddef>
#include <string>

#include "core/base/error.h"

namespace dmoscope {

/// A place in a formula's text, from 1; columns count letters, not bytes.
struct FormulaPlace {
  std::size_t line = 1, column = 1;
  friend bool operator==(const FormulaPlace&, const FormulaPlace&) = default;
};

/// A formula cannot be read or makes no sense. what() is "formula, column 7: what is wrong", with "line 2, " where there are several lines.
class FormulaError : public UsageError {
 public:
  FormulaError(FormulaPlace place, const std::string& what);
  [[nodiscard]] FormulaPlace place() const noexcept { return place_; }
  /// Without the place.
  [[nodiscard]] const std::string& reason() const noexcept { return reason_; }

 private:
  FormulaPlace place_;
  std::string reason_;
};

}  // namespace dmoscope
