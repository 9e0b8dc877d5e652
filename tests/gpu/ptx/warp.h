#pragma once
// Thirty-two lanes, which may pass values to each other.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "tests/gpu/ptx/lane.h"

namespace dmoscope::gpu::ptx {

/// What a device may do this way or that.
struct Schedule {
  bool together = false;   // activemask: all lanes that stand there, else each by itself
  bool backwards = false;  // the last lane and the last block first
  Races* races = nullptr;  // who watches for them; null: nobody
};

/// A launch: blocks of some threads, of which one runs after the other. Returns how many instructions its lanes did in all. Throws Fault,
/// which names kernel and instruction.
std::uint64_t run_blocks(const Entry& entry, const GlobalMemory& global, const std::vector<std::byte>& parameters, std::size_t blocks,
                         Schedule schedule, std::size_t threads = 128);

class Warp {
 public:
  static constexpr std::size_t kSize = 32;

  /// Threads first to first + 31 of a block, as far as it has them. `shared`: see Lane::start().
  void start(const Entry& entry, const GlobalMemory& global, const std::vector<std::byte>& parameters, std::span<std::byte> shared,
             std::uint32_t block, std::uint32_t first, std::size_t threads = 128);
  /// Until all lanes are done or at the block's barrier; returns whether they are done. Lanes run one by one until they must wait for each
  /// other.
  bool run(Schedule schedule);
  /// `first`: the agent that its first lane is, or is one of.
  void watch_for_races(Races* races, Agent first);
  /// Done by its lanes in all.
  [[nodiscard]] std::uint64_t instructions() const;
  /// From the barrier on, at which all of the block are.
  void pass_barrier();

 private:
  /// Each returns whether any lane could go on.
  bool exchange();
  bool tell_who_is_active(bool together);
  /// Are all of the lane's partners at the same shuffle? Fault where one can never be.
  [[nodiscard]] bool has_arrived(std::size_t lane, std::uint32_t members) const;
  void pass_values(std::uint32_t members);

  const Entry* entry_ = nullptr;
  std::size_t present_ = kSize;  // lanes that the block has
  std::array<Lane, kSize> lanes_;
};

/// A shuffle's answer for one lane: whose value it gets, and whether that lies within its bounds.
struct Source {
  std::uint32_t lane = 0;
  bool within = false;
};
/// b, c: the operands of these names. Of shfl.bfly or shfl.idx.
[[nodiscard]] Source shuffle_source(bool butterfly, std::uint32_t lane, std::uint32_t b, std::uint32_t c);

}  // namespace dmoscope::gpu::ptx
