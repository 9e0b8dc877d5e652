#pragma once
// How many visits a run makes between two looks at the cancel request and at who wants to see how far it is.

#include <algorithm>
#include <cstdint>
#include <utility>

namespace dmoscope {

/// So many that a block takes some 20 ms, judged by the slower ones of late. The result of a run does not depend on it.
class BlockPlan {
 public:
  /// On whom visits are made.
  enum class On {
    Host,
    Device,        // see Smoother::positions_on_device; a block is as much as fits the time, so a whole iteration of most meshes
    DeviceSolids,  // the same; a visit of a volume may take a small device so long that what all take must be known first
  };
  explicit BlockPlan(On on = On::Host)
      : most_(on == On::Host ? kMost : kMostFar),
        visits_(on == On::Host     ? kFirst
                : on == On::Device ? kMostFar
                                   : kFirstOfSolids),
        warming_up_(on != On::Host) {}

  /// Visits of the next block, at least 1; an iteration may have fewer left.
  [[nodiscard]] std::uint64_t visits() const noexcept { return visits_; }

  /// `visits` took `seconds`.
  void learn(std::uint64_t visits, double seconds) {
    if (visits == 0) return;
    if (std::exchange(warming_up_, false)) return;  // a device's first call also brings it positions and code
    visit_seconds_ = std::max(seconds / static_cast<double>(visits), kForgetting * visit_seconds_);
    const auto most = static_cast<double>(most_);
    visits_ = static_cast<std::uint64_t>(std::clamp(kSeconds / std::max(visit_seconds_, kSeconds / most), 1.0, most));
  }

 private:
  static constexpr double kSeconds = 0.02;
  /// Before anything is known of what visits take.
  static constexpr std::uint64_t kFirst = 2048;
  /// Enough for any device's lanes; at 250,000 operations in double a visit, a consumer's device takes some 10 ms for them.
  static constexpr std::uint64_t kFirstOfSolids = 32768;
  /// Visits to vertices at rest cost next to nothing, and the next may be to others: no more than are done before a person would wait.
  static constexpr std::uint64_t kMost = std::uint64_t{1} << 18U;
  /// Where a call is dear and a visit is not: far more than an iteration of any mesh.
  static constexpr std::uint64_t kMostFar = std::uint64_t{1} << 40U;
  /// How fast slow visits of the past are forgotten, block by block.
  static constexpr double kForgetting = 0.75;

  std::uint64_t most_;
  std::uint64_t visits_;
  bool warming_up_;
  double visit_seconds_ = 0.0;
};

}  // namespace dmoscope
