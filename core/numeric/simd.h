#pragma once
// Vector instructions that the search uses. The result has the same bits for any.

#include <cstdint>
#include <span>
#include <string_view>

namespace dmoscope {

/// Levels of vector instructions. Baseline is on every processor of the architecture: SSE2 on x86-64, NEON on 64-bit ARM. The others exist
/// on x86-64 only.
enum class SimdLevel : std::uint8_t { Baseline, Avx2, Avx512 };

/// The levels that this program has and this processor runs, lowest first; never empty.
[[nodiscard]] std::span<const SimdLevel> supported_simd_levels();
/// The highest of the supported levels.
[[nodiscard]] SimdLevel best_simd_level();
/// Word of a level: "baseline", "avx2", "avx512".
[[nodiscard]] std::string_view name(SimdLevel level);
/// Parses the word of a level. Throws UsageError for an unknown one (listing the known ones) and for a level that this processor lacks.
[[nodiscard]] SimdLevel parse_simd_level(std::string_view name);

}  // namespace dmoscope
