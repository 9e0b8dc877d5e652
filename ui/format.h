#pragma once
// How numbers are written on screen.

#include <cstdint>
#include <string>

namespace dmoscope::ui {

/// Four significant digits ("0.3124", "12.50", "1.235e+06"); "–" for NaN and infinity.
[[nodiscard]] std::string short_number(double value);
/// All digits: the shortest text that reads back as the same double.
[[nodiscard]] std::string full_number(double value);
/// Thousands apart: "1,334,112".
[[nodiscard]] std::string count(std::uint64_t value);
/// "1.61 M" for rates: three digits and a prefix.
[[nodiscard]] std::string rate(double value);
/// "0.83 ms", "1.24 s".
[[nodiscard]] std::string duration(double seconds);
/// "1 vertex", "8,429 vertices".
[[nodiscard]] std::string counted(std::uint64_t value, const char* one, const char* many);

}  // namespace dmoscope::ui
