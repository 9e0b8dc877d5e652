#pragma once
// A small SELAFIN file of TELEMAC: two triangles, two variables, two time steps.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/reading/binary.h"

namespace dmoscope::testing {

inline std::string selafin_sample(bool big_endian, bool doubles) {
  std::string bytes;
  const auto put = [&](auto value) {
    const auto raw = store_number(value, big_endian);
    bytes.append(raw.data(), raw.size());
  };
  const auto record = [&](std::size_t size, const auto& fill) {
    put(static_cast<std::uint32_t>(size));
    fill();
    put(static_cast<std::uint32_t>(size));
  };
  const auto text = [&](std::string words, std::size_t size) {
    words.resize(size, ' ');
    record(size, [&] { bytes += words; });
  };
  const auto wholes = [&](const std::vector<std::int32_t>& values) {
    record(4 * values.size(), [&] {
      for (const std::int32_t value : values) put(value);
    });
  };
  const auto reals = [&](const std::vector<double>& values) {
    record((doubles ? 8 : 4) * values.size(), [&] {
      for (const double value : values) {
        if (doubles)
          put(value);
        else
          put(static_cast<float>(value));
      }
    });
  };
  std::string title = "a basin";
  title.resize(72, ' ');
  text(title + (doubles ? "SERAFIND" : "SERAFIN "), 80);
  wholes({2, 0});
  text("BOTTOM          M", 32);
  text("WATER DEPTH     M", 32);
  wholes({1, 0, 0, 0, 0, 0, 0, 0, 0, 1});
  wholes({2020, 1, 2, 3, 4, 5});
  wholes({2, 4, 3, 1});
  wholes({1, 2, 3, 1, 3, 4});
  wholes({1, 2, 3, 4});
  reals({0, 1, 1, 0});
  reals({0, 0, 1, 1.5});
  for (const double time : {0.0, 60.0}) {
    reals({time});
    reals({-1, -2, -3, -4});
    reals({1 + time, 2 + time, 3 + time, 4 + time});
  }
  return bytes;
}

}  // namespace dmoscope::testing
