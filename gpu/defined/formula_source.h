#pragma once
// CUDA source of the search by a metric's programs, to be compiled at run time: straight code in a program's place, which gives the same
// bits.

#include <optional>
#include <string>
#include <vector>

#include "gpu/defined/program_table.h"

namespace dmoscope::gpu {

/// Properties of the search that its source depends on.
struct SearchShape {
  bool is_volume = false, in_double = false;
};

/// Returns the source, which includes headers of formula_headers(); none if the programs are so long that compiling them would take longer
/// than their use.
[[nodiscard]] std::optional<std::string> formula_source(const ProgramTable& table, SearchShape shape);
/// Name of the kernel in the source. Its parameters: a StarSearchTask, and the number of warps as std::size_t; one star a warp at a time.
inline constexpr const char* kFormulaKernel = "search_stars";
/// Threads in a block, and in a team.
inline constexpr unsigned kFormulaBlock = 128, kFormulaWarp = 32;

/// A header that the source includes.
struct SourceHeader {
  std::string name, text;
};
/// Headers of dmoscope, as they were when it was compiled, and stand-ins for the few of the standard library that these include.
[[nodiscard]] const std::vector<SourceHeader>& formula_headers();

}  // namespace dmoscope::gpu
