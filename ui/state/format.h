#pragma once
// How numbers and names are written on screen.

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/number_text.h"
#include "core/quality/metric_phrase.h"
#include "core/run/size_course.h"

namespace dmoscope::ui {

/// Four significant digits ("0.3124", "12.50", "1.235e+06"); "–" for NaN and infinity.
[[nodiscard]] std::string short_number(double value);
/// All digits: the shortest text that reads back as the same double.
[[nodiscard]] std::string full_number(double value);
/// Thousands apart: "1,334,112".
[[nodiscard]] std::string count(std::uint64_t value);
/// "1.61 M" for rates: three digits and a prefix.
[[nodiscard]] std::string rate(double value);
/// ASCII letters made small, to compare what people type.
[[nodiscard]] std::string lower_case(std::string_view text);
/// At most so many letters (bytes of UTF-8) of a text, "…" in place of its middle: "mean-r…-area".
[[nodiscard]] std::string without_middle(std::string_view text, std::size_t letters);
/// "0.041 → 0.734": how well sizes are met, at the input and now; "–" where there are none.
[[nodiscard]] std::string size_course_text(double before, double after);
/// The same in full, and of the sizes' logarithms, in two lines.
[[nodiscard]] std::string size_course_details(const SizeCourse& sizes);
/// "Mean ratio" of a metric.
[[nodiscard]] std::string metric_title(Metric metric);
/// "0.83 ms", "1.24 s".
[[nodiscard]] std::string duration(double seconds);
/// With a capital letter at its begin.
[[nodiscard]] std::string capitalised(std::string text);
/// Arrows in place of "->", which is for terminals.
[[nodiscard]] std::string with_arrows(std::string text);

}  // namespace dmoscope::ui
