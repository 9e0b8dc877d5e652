#include "core/numeric/simd.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/unknown_value.h"

namespace dmoscope {

namespace {

constexpr std::array kAll{SimdLevel::Baseline, SimdLevel::Avx2, SimdLevel::Avx512};
constexpr std::array<std::string_view, kAll.size()> kNames{"baseline", "avx2", "avx512"};

/// Number of levels of kAll that this processor has; each needs the ones before it.
std::size_t supported_count() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return 1;
  for (const bool has :
       {__builtin_cpu_supports("avx512f") != 0, __builtin_cpu_supports("avx512cd") != 0, __builtin_cpu_supports("avx512dq") != 0,
        __builtin_cpu_supports("avx512bw") != 0, __builtin_cpu_supports("avx512vl") != 0})
    if (!has) return 2;
  return 3;
#else
  return 1;
#endif
}

}  // namespace

std::span<const SimdLevel> supported_simd_levels() {
  static const std::size_t count = supported_count();
  return std::span(kAll).first(count);
}

SimdLevel best_simd_level() { return supported_simd_levels().back(); }

std::string_view name(SimdLevel level) { return kNames[static_cast<std::size_t>(level)]; }

SimdLevel parse_simd_level(std::string_view text) {
  const auto found = std::ranges::find(kNames, text);
  if (found == kNames.end()) throw UsageError(unknown_value("SIMD level", text, kNames));
  const SimdLevel level = kAll[static_cast<std::size_t>(found - kNames.begin())];
  if (level > best_simd_level())
    throw UsageError(fmt::format("this processor has no {}; its highest SIMD level is {}", text, name(best_simd_level())));
  return level;
}

}  // namespace dmoscope
