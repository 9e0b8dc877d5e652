#pragma once
// Positions of a run on the host, and which moment they show while a device smooths ahead of them.

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/stopwatch.h"
#include "core/mesh/mesh.h"
#include "core/run/history.h"
#include "core/run/moment.h"

namespace dmoscope {

/// Moment, with the progress of the iteration under way.
struct RunProgress {
  Moment moment{};
  std::uint64_t moved = 0;
  double seconds = 0.0;        // duration of smoothing
  std::uint64_t searched = 0;  // see IterationRecord
  std::optional<JointFigures> joint{};
};

/// Copy of a run's positions on the host, and the moment that it shows. A smoother that keeps positions on a device runs ahead of it until
/// download().
class PositionBuffer {
 public:
  /// Begins with the positions of the run's first moment.
  explicit PositionBuffer(std::vector<Vec3> positions) : host_(std::move(positions)) {}

  /// The host's copy, whichever moment it shows.
  [[nodiscard]] std::span<Vec3> host() noexcept { return host_; }
  [[nodiscard]] std::span<const Vec3> host() const noexcept { return host_; }
  /// Moment that the host's copy shows; none: a download failed in its midst, and the copy is of no use.
  [[nodiscard]] const std::optional<RunProgress>& host_shows() const noexcept { return shows_; }
  [[nodiscard]] bool host_is_at(const Moment& moment) const noexcept { return shows_ && shows_->moment == moment; }
  /// Duration of the last download.
  [[nodiscard]] double download_seconds() const noexcept { return download_seconds_; }

  /// Brings the host's copy up to `now` by `store(positions)`, unless it shows that already. Throws what `store` throws.
  template <class Store>
  void download(const RunProgress& now, const Store& store) {
    if (host_is_at(now.moment)) return;
    const Stopwatch watch;
    shows_.reset();
    store(std::span<Vec3>(host_));
    shows_ = now;
    download_seconds_ = watch.seconds();
  }
  /// Replaces the host's copy.
  void assign(std::span<const Vec3> positions, const RunProgress& shows) {
    host_.assign(positions.begin(), positions.end());
    shows_ = shows;
  }

 private:
  std::vector<Vec3> host_;
  std::optional<RunProgress> shows_ = RunProgress{};
  double download_seconds_ = 0.0;
};

}  // namespace dmoscope
