#pragma once
// Makes the immutable pictures of a session that the engine publishes.

#include <cstdint>
#include <memory>
#include <vector>

#include "core/session/session.h"
#include "core/session/view.h"

namespace dmoscope {

/// Whole: everything is in the frame. Live: what lives on a device stays there, see Frame.
enum class FrameDetail { Whole, Live };

class FrameBuilder {
 public:
  /// The session as it stands. Qualities are computed with the session's pool. Throws DeviceError.
  [[nodiscard]] std::shared_ptr<const SessionView> build(Session& session, FrameDetail detail = FrameDetail::Whole);

 private:
  std::shared_ptr<const Frame> frame(Session& session, FrameDetail detail);
  void refresh_input(Session& session);

  std::uint64_t serial_ = 0;
  std::uint64_t input_serial_ = 0;
  std::shared_ptr<const InputMesh> input_;  // of the frames so far
  Metric before_metric_ = Metric::MeanRatio;
  Histogram before_;  // of before_metric_ at the input
};

/// Counts of `qualities` between 0, below which elements are inverted, and 1, the ideal element; NaN is left out.
[[nodiscard]] Histogram make_histogram(std::span<const double> qualities);

/// The worst `most` elements, worst first, ties by index. NaN is left out.
[[nodiscard]] std::vector<RankedElement> worst_elements(std::span<const double> qualities, std::size_t most);

}  // namespace dmoscope
