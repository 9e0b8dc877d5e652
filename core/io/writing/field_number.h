#pragma once
// Numbers for formats whose fields have a fixed width.

#include <cstddef>
#include <string>

namespace dmoscope {

/// Notation of a power of ten: 1.5e-7, or in Nastran's, which saves a character: 1.5-7.
enum class ExponentStyle { Letter, Sign };

struct FieldNumber {
  std::string text;
  double value = 0.0;  // value that the text reads back as
};

/// A finite double in `width` characters at most (16 or more): exact if that fits, else rounded to as many digits as possible. Always with
/// a point, by which some formats recognise a real number.
[[nodiscard]] FieldNumber number_in_field(double value, std::size_t width, ExponentStyle style);

}  // namespace dmoscope
