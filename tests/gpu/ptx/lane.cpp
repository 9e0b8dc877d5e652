#include "tests/gpu/ptx/lane.h"

#include <algorithm>

#include <fmt/format.h>

namespace dmoscope::gpu::ptx {

namespace {
constexpr std::uint64_t kMostJumps = 1U << 24U;
}

void Lane::start(const Entry& entry, const GlobalMemory& global, const std::vector<std::byte>& parameters, std::span<std::byte> shared,
                 std::uint32_t block, std::uint32_t thread) {
  if (entry_ != &entry) {
    slots_ = std::make_unique_for_overwrite<std::uint64_t[]>(entry.slot_count);
    std::ranges::copy(entry.initial, slots_.get());
    local_memory_.resize((entry.local_bytes + sizeof(std::max_align_t) - 1) / sizeof(std::max_align_t));
  }
  if (entry.local_bytes > 0) std::memset(static_cast<void*>(local_memory_.data()), 0xcd, entry.local_bytes);
  entry_ = &entry;
  global_ = &global;
  shared_ = shared;
  local_ = {reinterpret_cast<std::uintptr_t>(local_memory_.data()), entry.local_bytes};
  parameters_ = {reinterpret_cast<std::uintptr_t>(parameters.data()), parameters.size()};
  put(kThread, thread);
  put(kBlock, block);
  put(kLocal, local_.begin);
  for (std::size_t i = 0; i < entry.parameters.size(); ++i)
    put(static_cast<Slot>(kFirstParameter + i), parameters_.begin + entry.parameters[i]);
  at_ = 0;
  jumps_left_ = kMostJumps;
  state_ = State::Running;
}

void Lane::run() {
  const Instruction* const code = entry_->code.data();
  while (state_ == State::Running) {
    const Instruction& instruction = code[at_++];
    ++instructions_;
    try {
      instruction.run(*this, instruction);
    } catch (const Fault& fault) {
      throw Fault(fmt::format("{}: {}: {}", entry_->name, entry_->texts[instruction.text], fault.what()));
    }
  }
}

std::byte* Lane::memory(Space space, std::uintptr_t address, std::size_t size, std::size_t aligned) const {
  if (space == Space::Shared) {
    if (!Extent{kSharedBase, shared_.size()}.holds(address, size))
      throw Fault(fmt::format("out of bounds: {} bytes at {:#x} of shared memory", size, address));
    if (address % aligned != 0) throw Fault(fmt::format("misaligned: {:#x} is no multiple of {}", address, aligned));
    return shared_.data() + (address - kSharedBase);
  }
  const bool there = (space == Space::Global && global_->holds(address, size)) || (space == Space::Local && local_.holds(address, size)) ||
                     (space == Space::Parameter && parameters_.holds(address, size)) ||
                     (space == Space::Generic && (local_.holds(address, size) || global_->holds(address, size)));
  if (!there) throw Fault(fmt::format("out of bounds: {} bytes at {:#x}", size, address));
  if (address % aligned != 0) throw Fault(fmt::format("misaligned: {:#x} is no multiple of {}", address, aligned));
  return reinterpret_cast<std::byte*>(address);
}

}  // namespace dmoscope::gpu::ptx
