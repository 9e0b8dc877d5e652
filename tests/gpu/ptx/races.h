#pragma once
// Detector of conflicting accesses in one launch, or in several that are done at once: the order of their lanes must not matter.

#include <cstdint>
#include <unordered_map>

#include <fmt/format.h>

#include "tests/gpu/ptx/memory.h"

namespace dmoscope::gpu::ptx {

/// A lane, or all lanes of a team, which wait for each other between writing and reading.
using Agent = std::uint64_t;

/// Accesses of agents. Each call throws Fault if the memory is another agent's to write. Addresses: words of four bytes, or single bytes of
/// flags.
class Races {
 public:
  /// Forgets all accesses: the launches were waited for.
  void forget() {
    cells_.clear();
    launches_ = 0;
  }
  /// The first agent of the next launch.
  [[nodiscard]] Agent first_agent() { return ++launches_ << 40U; }

  void read(std::uintptr_t address, Agent agent) {
    Cell& cell = cells_[address];
    if (cell.writer.is_other(agent)) throw Fault(fmt::format("race: {:#x} is read, and written by another", address));
    if (cell.adder.is_other(agent)) throw Fault(fmt::format("race: {:#x} is read, and counted up by another", address));
    cell.reader.add(agent);
  }
  /// Notes a write. Several agents may write one value, as they do with flags.
  void write(std::uintptr_t address, Agent agent, std::uint64_t value) {
    Cell& cell = cells_[address];
    if (cell.reader.is_other(agent)) throw Fault(fmt::format("race: {:#x} is written, and read by another", address));
    if (cell.adder.is_other(agent)) throw Fault(fmt::format("race: {:#x} is written, and counted up by another", address));
    if (cell.writer.is_other(agent) && cell.value != value)
      throw Fault(fmt::format("race: {:#x} is written, and by another, to something else", address));
    cell.writer.add(agent);
    cell.value = value;
  }
  /// Notes an atomic addition, by an agent that reads the value before.
  void count_up(std::uintptr_t address, Agent agent) {
    Cell& cell = cells_[address];
    if (cell.reader.is_other(agent) || cell.writer.is_other(agent))
      throw Fault(fmt::format("race: {:#x} is counted up, and read or written by another", address));
    cell.adder.add(agent);
  }

 private:
  class Agents {
   public:
    [[nodiscard]] bool is_other(Agent agent) const noexcept { return many_ || (one_ != 0 && one_ != agent); }
    void add(Agent agent) noexcept {
      many_ = many_ || (one_ != 0 && one_ != agent);
      one_ = agent;
    }

   private:
    Agent one_ = 0;
    bool many_ = false;
  };
  struct Cell {
    Agents reader, writer, adder;
    std::uint64_t value = 0;
  };

  std::unordered_map<std::uintptr_t, Cell> cells_;
  Agent launches_ = 0;
};

}  // namespace dmoscope::gpu::ptx
