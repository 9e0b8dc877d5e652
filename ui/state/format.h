#pragma once
// Numbers and names as texts for the screen.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/number_text.h"
#include "core/quality/metric_phrase.h"
#include "core/run/size_course.h"

namespace dmoscope::ui {

/// Four significant digits ("0.3124", "12.50", "1.235e+06"); "–" for NaN and infinity.
[[nodiscard]] std::string short_number(double value);
/// A number with all digits: the shortest text that reads back as the same double.
[[nodiscard]] std::string full_number(double value);
/// A number with its thousands apart: "1,334,112".
[[nodiscard]] std::string count(std::uint64_t value);
/// An angle in degrees: "38.8°", "0.66°".
[[nodiscard]] std::string degrees(double angle);
/// A rate with three digits and a prefix: "1.61 M".
[[nodiscard]] std::string rate(double value);
/// A text with its ASCII letters made small, for comparing what people type.
[[nodiscard]] std::string lower_case(std::string_view text);
/// At most so many letters (bytes of UTF-8) of a text, "…" in place of its middle: "mean-r…-area".
[[nodiscard]] std::string without_middle(std::string_view text, std::size_t letters);
/// How well sizes are met, at the input and now: "0.041 → 0.734"; "–" when there are no sizes.
[[nodiscard]] std::string size_course_text(double before, double after);
/// How well sizes and their logarithms are met, in full, in two lines.
[[nodiscard]] std::string size_course_details(const SizeCourse& sizes);
/// Title of a metric: "Mean ratio".
[[nodiscard]] std::string metric_title(Metric metric);
/// A time: "0.83 ms", "1.24 s".
[[nodiscard]] std::string duration(double seconds);
/// A text with a capital first letter.
[[nodiscard]] std::string capitalised(std::string text);
/// A text with arrows in place of "->", which is for terminals.
[[nodiscard]] std::string with_arrows(std::string text);

/// Last part of each path; if several share it, it is followed by as many folders as tell them apart: "east.14   results/a".
[[nodiscard]] std::vector<std::string> short_names(std::span<const std::string> files);

}  // namespace dmoscope::ui
