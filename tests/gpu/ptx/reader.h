#pragma once
// PTX, as nvcc writes it, into what a lane can run.

#include <string>
#include <string_view>
#include <vector>

#include "tests/gpu/ptx/lane.h"

namespace dmoscope::gpu::ptx {

/// A kernel's text, not yet decoded.
struct EntryText {
  std::string name;                   // mangled
  std::string text;                   // from ".visible" or ".entry" to the closing brace
  std::vector<std::string> shared{};  // declarations of shared memory outside of it
};
/// All kernels of a file's text. Throws Fault where there is anything else that could be run or read, such as a function or a constant.
[[nodiscard]] std::vector<EntryText> find_entries(std::string_view ptx);

/// Throws Fault, with the instruction, where there is one that is not known, or that reads a register that may not have been written.
[[nodiscard]] Entry decode(const EntryText& entry);

}  // namespace dmoscope::gpu::ptx
