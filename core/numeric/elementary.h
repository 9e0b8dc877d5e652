#pragma once
// Elementary functions with the same bits on every processor, unlike the library's: by operations that IEEE 754 defines alone. Each is
// right to a few units in the last place and defined for every number; what has no value has the nearest that has one.

namespace dmoscope::elementary {

/// e^x; of what is beyond +-700 as of +-700.
[[nodiscard]] double exponential(double x);
/// The natural logarithm; of 0 and less -700.
[[nodiscard]] double logarithm(double x);
/// In radians; 0 for more than 1e9 either way, whose angle a double hardly tells.
[[nodiscard]] double sine(double x);
[[nodiscard]] double cosine(double x);
/// x^y by way of the logarithm; 0 for x <= 0.
[[nodiscard]] double power(double x, double y);

}  // namespace dmoscope::elementary
