#pragma once
// Makes the immutable pictures of a session that the engine publishes.

#include <cstdint>
#include <memory>
#include <vector>

#include "core/session/session.h"
#include "core/session/summaries.h"
#include "core/session/view.h"

namespace dmoscope {

/// Whole: everything is in the frame. Live: what lives on a device stays there, see Frame.
enum class FrameDetail { Whole, Live };

class FrameBuilder {
 public:
  /// The session as it stands. Qualities are computed with the session's pool. Throws DeviceError.
  [[nodiscard]] std::shared_ptr<const SessionView> build(Session& session, FrameDetail detail = FrameDetail::Whole);
  /// Works out what views show besides frames, percentiles and summaries of all runs, as long as `go_on`, which is asked every now and
  /// then, says so. Returns whether there is something new to show. Throws DeviceError.
  bool work_at_rest(Session& session, const std::function<bool()>& go_on);

 private:
  /// What a frame is of: as long as it is the same, so is the frame.
  struct FrameKey {
    std::weak_ptr<const Run> run;
    std::size_t index = 0;
    std::uint64_t path = 0;
    Moment moment;
    Metric shown = Metric::MeanRatio;
    [[nodiscard]] bool is(const FrameKey& other) const;
  };
  static FrameKey key_of(Session& session);
  std::shared_ptr<const Frame> frame(Session& session, FrameDetail detail);
  void refresh_input(Session& session);

  std::uint64_t serial_ = 0;
  std::uint64_t input_serial_ = 0;
  std::shared_ptr<const InputMesh> input_;  // of the frames so far
  Metric before_metric_ = Metric::MeanRatio;
  Histogram before_;  // of before_metric_ at the input
  FrameKey last_key_;
  std::shared_ptr<const Frame> last_;  // whole; of last_key_
  Summaries summaries_;
};

/// A frame of any run, for its qualities alone.
[[nodiscard]] Frame judged(Session& session, std::size_t run);

/// Counts of `qualities` between 0, below which elements are inverted, and 1, the ideal element; NaN is left out.
[[nodiscard]] Histogram make_histogram(std::span<const double> qualities);

/// The worst `most` elements, worst first, ties by index. NaN is left out.
[[nodiscard]] std::vector<RankedElement> worst_elements(std::span<const double> qualities, std::size_t most);

}  // namespace dmoscope
