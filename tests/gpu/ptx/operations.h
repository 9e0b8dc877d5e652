#pragma once
// Effects of PTX's instructions, by the text of the opcode. After NVIDIA's "PTX ISA"; only those that nvcc uses in the kernels.

#include <optional>
#include <string_view>

#include "tests/gpu/ptx/lane.h"

namespace dmoscope::gpu::ptx {

struct Operation {
  Handler run = nullptr;
  std::uint8_t written = 0, used = 0, copied = 0;  // see Instruction
};

/// The operation of an opcode whose operands are only registers and constants, such as "add.rn.f32".
[[nodiscard]] std::optional<Operation> find_operation(std::string_view opcode);

/// An access to memory ("ld.global.v2.f32", "st.local.u8", "atom.global.add.u32"): the operation for each element of the vector.
struct Access {
  Operation operation;    // slots: register, address[, register]; of a store: address, register
  std::size_t size = 0;   // bytes of an element
  std::size_t count = 0;  // elements
  bool is_load = false;
};
[[nodiscard]] std::optional<Access> find_access(std::string_view opcode);

/// Branches. offset: the target; slots[0]: the predicate of the conditional two.
extern const Operation kJump, kJumpIf, kJumpUnless;
/// The instruction mov.b64 d, {a, b} and its reverse, which is two instructions.
extern const Operation kPack, kLowHalf, kHighHalf;
/// The instruction mov.b32 d, {a, b} and its reverse.
extern const Operation kPackShort, kLowShort, kHighShort;

}  // namespace dmoscope::gpu::ptx
