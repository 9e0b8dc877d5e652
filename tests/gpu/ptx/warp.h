#pragma once
// Thirty-two lanes, which may pass values to each other.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "tests/gpu/ptx/lane.h"

namespace dmoscope::gpu::ptx {

/// Choices that a device is free to make.
struct Schedule {
  bool together = false;   // activemask: all lanes at the same instruction, else each by itself
  bool backwards = false;  // the last lane and the last block run first
  Races* races = nullptr;  // the detector of races; null: none
};

/// Runs a launch: blocks of some threads, one after the other. Returns the number of instructions of all its lanes. Throws Fault, which
/// names kernel and instruction.
std::uint64_t run_blocks(const Entry& entry, const GlobalMemory& global, const std::vector<std::byte>& parameters, std::size_t blocks,
                         Schedule schedule, std::size_t threads = 128);

class Warp {
 public:
  static constexpr std::size_t kSize = 32;

  /// Starts threads first to first + 31 of a block, as far as it has them. `shared`: see Lane::start().
  void start(const Entry& entry, const GlobalMemory& global, const std::vector<std::byte>& parameters, std::span<std::byte> shared,
             std::uint32_t block, std::uint32_t first, std::size_t threads = 128);
  /// Runs until all lanes are done or at the block's barrier; returns whether they are done. Lanes run one by one until they must wait for
  /// each other.
  bool run(Schedule schedule);
  /// Sets the detector of races. `first`: the agent that its first lane is, or is part of.
  void watch_for_races(Races* races, Agent first);
  /// Number of instructions of its lanes.
  [[nodiscard]] std::uint64_t instructions() const;
  /// Continues after the barrier, which all of the block have reached.
  void pass_barrier();

 private:
  /// Lets waiting lanes exchange or meet; each returns whether any lane could go on.
  bool exchange();
  bool tell_who_is_active(bool together);
  /// Whether all of the lane's partners are at the same shuffle. Throws Fault if one can never be.
  [[nodiscard]] bool has_arrived(std::size_t lane, std::uint32_t members) const;
  void pass_values(std::uint32_t members);

  const Entry* entry_ = nullptr;
  std::size_t present_ = kSize;  // number of lanes of the block in this warp
  std::array<Lane, kSize> lanes_;
};

/// Source of a shuffle for one lane: the lane whose value it gets, and whether that lies within its bounds.
struct Source {
  std::uint32_t lane = 0;
  bool within = false;
};
/// The source of shfl.bfly or shfl.idx. b, c: the operands of these names.
[[nodiscard]] Source shuffle_source(bool butterfly, std::uint32_t lane, std::uint32_t b, std::uint32_t c);

}  // namespace dmoscope::gpu::ptx
