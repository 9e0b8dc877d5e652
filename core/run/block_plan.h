#pragma once
// Number of visits that a run makes between two looks at the cancel request and at observers of its progress.

#include <algorithm>
#include <cstdint>
#include <utility>

namespace dmoscope {

/// Chooses blocks that take some 20 ms each, judged by the slower ones of late. The result of a run does not depend on it.
class BlockPlan {
 public:
  /// Backend that makes the visits.
  enum class On {
    Host,
    Device,        // see Smoother::positions_on_device; a block is as much as fits the time, so a whole iteration of most meshes
    DeviceSolids,  // on a device, too; a visit of a volume may take a small device so long that the time of a block must be known first
  };
  explicit BlockPlan(On on = On::Host)
      : most_(on == On::Host ? kMost : kMostFar),
        visits_(on == On::Host     ? kFirst
                : on == On::Device ? kMostFar
                                   : kFirstOfSolids),
        warming_up_(on != On::Host) {}

  /// Number of visits of the next block, at least 1; an iteration may have fewer left.
  [[nodiscard]] std::uint64_t visits() const noexcept { return visits_; }

  /// Learns that `visits` took `seconds`.
  void learn(std::uint64_t visits, double seconds) {
    if (visits == 0) return;
    if (std::exchange(warming_up_, false)) return;  // a device's first call also brings it positions and code
    visit_seconds_ = std::max(seconds / static_cast<double>(visits), kForgetting * visit_seconds_);
    const auto most = static_cast<double>(most_);
    visits_ = static_cast<std::uint64_t>(std::clamp(kSeconds / std::max(visit_seconds_, kSeconds / most), 1.0, most));
  }

 private:
  static constexpr double kSeconds = 0.02;
  /// Visits of the first block, while their duration is unknown.
  static constexpr std::uint64_t kFirst = 2048;
  /// Enough for any device's lanes; at 250,000 operations in double a visit, a consumer's device takes some 10 ms for them.
  static constexpr std::uint64_t kFirstOfSolids = 32768;
  /// Visits to vertices at rest cost next to nothing, and the next may be to others: no more than are done before a person would wait.
  static constexpr std::uint64_t kMost = std::uint64_t{1} << 18U;
  /// Visits of a block where a call is dear and a visit is not: far more than an iteration of any mesh.
  static constexpr std::uint64_t kMostFar = std::uint64_t{1} << 40U;
  /// Factor by which slow visits of the past are forgotten, block by block.
  static constexpr double kForgetting = 0.75;

  std::uint64_t most_;
  std::uint64_t visits_;
  bool warming_up_;
  double visit_seconds_ = 0.0;
};

}  // namespace dmoscope
