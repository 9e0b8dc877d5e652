#pragma once
// The search by a metric's programs as CUDA source, for a compiler that is called while dmoscope runs: straight code in a program's place,
// which gives the same bits.

#include <optional>
#include <string>
#include <vector>

#include "gpu/defined/program_table.h"

namespace dmoscope::gpu {

/// What the search is for.
struct SearchShape {
  bool is_volume = false, in_double = false;
};

/// None where the programs are so long that compiling them would take longer than their use. It includes headers of formula_headers().
[[nodiscard]] std::optional<std::string> formula_source(const ProgramTable& table, SearchShape shape);
/// The kernel's name in it. Its parameters: a StarSearchTask, and the number of warps as std::size_t; one star a warp at a time.
inline constexpr const char* kFormulaKernel = "search_stars";
/// Threads a block, and a team.
inline constexpr unsigned kFormulaBlock = 128, kFormulaWarp = 32;

/// A header that the source includes.
struct SourceHeader {
  std::string name, text;
};
/// dmoscope's own, as they were when it was compiled, and stand-ins for the few of the standard library that these include.
[[nodiscard]] const std::vector<SourceHeader>& formula_headers();

}  // namespace dmoscope::gpu
