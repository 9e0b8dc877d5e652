#pragma once
// Decoder of PTX, in nvcc's form, for lanes.

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
/// Finds all kernels of a file's text. Throws Fault if there is anything else that could be run or read, such as a function or a constant.
[[nodiscard]] std::vector<EntryText> find_entries(std::string_view ptx);

/// Decodes a kernel. Throws Fault, with the instruction, for one that is not known, or that reads a register that may not have been
/// written.
[[nodiscard]] Entry decode(const EntryText& entry);

}  // namespace dmoscope::gpu::ptx
