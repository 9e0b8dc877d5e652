#pragma once
// Thirty-two lanes, which may pass values to each other.

#include <array>
#include <cstddef>
#include <vector>

#include "tests/gpu/ptx/lane.h"

namespace dmoscope::gpu::ptx {

/// What a device may do this way or that.
struct Schedule {
  bool together = false;   // activemask: all lanes that stand there, else each by itself
  bool backwards = false;  // the last lane and the last block first
};

/// A launch: blocks of some threads, of which one runs after the other. Throws Fault, which names kernel and instruction.
void run_blocks(const Entry& entry, const GlobalMemory& global, const std::vector<std::byte>& parameters, std::size_t blocks,
                Schedule schedule, std::size_t threads = 128);

class Warp {
 public:
  static constexpr std::size_t kSize = 32;

  /// Runs threads first to first + 31 of a block, as far as it has them, to their end. Lanes run one by one until they must wait for each
  /// other.
  void run(const Entry& entry, const GlobalMemory& global, const std::vector<std::byte>& parameters, std::uint32_t block,
           std::uint32_t first, Schedule schedule, std::size_t threads = 128);

 private:
  /// Each returns whether any lane could go on.
  bool exchange();
  bool tell_who_is_active(bool together);
  /// Are all of the lane's partners at the same shuffle? Fault where one can never be.
  [[nodiscard]] bool has_arrived(std::size_t lane, std::uint32_t members) const;
  void pass_values(std::uint32_t members);

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
