#pragma once
// Numbers for formats whose fields have a fixed width.

#include <cstddef>
#include <string>

namespace dmoscope {

/// How a power of ten is written: 1.5e-7, or as Nastran does it, which saves a character: 1.5-7.
enum class ExponentStyle { Letter, Sign };

struct FieldNumber {
  std::string text;
  double value = 0.0;  // what the text reads back as
};

/// A finite double in `width` characters at most (16 or more): the very number where it fits, else rounded to as many digits as do.
/// Always with a point, which some formats take for the mark of a real number.
[[nodiscard]] FieldNumber number_in_field(double value, std::size_t width, ExponentStyle style);

}  // namespace dmoscope
