#pragma once
// Builder of the immutable views of a session that the engine publishes.

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "core/session/session.h"
#include "core/view/judgements.h"
#include "core/view/judging.h"
#include "core/view/summaries.h"
#include "core/view/view.h"

namespace dmoscope {

/// Completeness of a frame. Whole: everything is in it. Live: data on a device stay there, see Frame. Quick: like Live, and data that need
/// another pass over all elements are left to the next frame, see Frame::provisional.
enum class FrameDetail { Whole, Live, Quick };

class FrameBuilder {
 public:
  /// Builds a view of the session's present state, with frames of its active run and of what is watched. Qualities are computed with the
  /// session's pool. Throws DeviceError for the active run.
  [[nodiscard]] std::shared_ptr<const SessionView> build(Session& session, FrameDetail detail = FrameDetail::Whole,
                                                         std::span<const Watch> watched = {});
  /// Computes data that take long and nobody waits for: watched states that are no longer kept, percentiles, and summaries of all runs.
  /// Continues as long as `go_on`, which is asked now and then, returns true. Returns whether there is something new to show. Throws
  /// DeviceError.
  bool work_at_rest(Session& session, std::span<const Watch> watched, const std::function<bool()>& go_on);
  /// Computes data that take seconds, after all others; see work_at_rest().
  bool work_long_at_rest(Session& session, const std::function<bool()>& go_on);
  /// Tries possible changes, last of all; see work_at_rest().
  bool try_at_rest(Session& session, const std::function<bool()>& go_on);

 private:
  /// Key of a frame: as long as it is unchanged, so is the frame.
  struct FrameKey {
    StandingRun at{};  // moment of a run; without a run: the input
    std::size_t index = Frame::kNoRun;
    Metric shown = Metric::MeanRatio;
    StandingRule rule{};  // for the input: rule of its fixed vertices, that of the active run
    [[nodiscard]] bool is(const FrameKey& other) const;
  };
  struct Known {
    FrameKey key;
    std::shared_ptr<const Frame> frame;
    bool wanted = true;  // whether it belongs to the view being built
  };
  /// Data that all frames of a mesh share.
  struct InputFacts {
    std::shared_ptr<const InputMesh> input;
    std::uint64_t serial = 0;
    std::map<Metric, std::shared_ptr<const InputSpread>> before;  // spreads by the metrics shown so far
  };
  static const std::shared_ptr<const InputMesh>& input_of(Session& session, const FrameKey& key);
  static FrameKey key_of(Session& session, std::size_t run);
  /// Key of a run's state at the end of an iteration.
  static FrameKey key_of(Session& session, std::size_t run, std::uint64_t iteration);
  /// Finds a known frame; a provisional one only if `detail` allows that.
  [[nodiscard]] Known* find(Session& session, const FrameKey& key, FrameDetail detail = FrameDetail::Whole);
  std::shared_ptr<const Frame> keep(FrameKey key, std::shared_ptr<const Frame> frame);
  [[nodiscard]] std::shared_ptr<Frame> begin(Session& session, const FrameKey& key, FrameDetail detail);
  std::shared_ptr<const Frame> standing(Session& session, std::size_t run, FrameDetail detail);
  [[nodiscard]] WatchedFrame watch_standing(Session& session, const Watch& what, std::size_t run, FrameDetail detail);
  std::shared_ptr<const Frame> past(Session& session, std::size_t run, std::uint64_t iteration, std::span<const Vec3> positions,
                                    FrameDetail detail);
  std::shared_ptr<const Frame> input_frame(Session& session, FrameDetail detail);
  [[nodiscard]] WatchedFrame watch(Session& session, const Watch& what, FrameDetail detail);
  bool find_past(Session& session, std::span<const Watch> watched, const std::function<bool()>& go_on);
  InputFacts& facts_of(Session& session, const std::shared_ptr<const InputMesh>& input);
  std::shared_ptr<const InputSpread> spread_at(Session& session, InputFacts& facts, FrameDetail detail);
  void add_meshes(Session& session, SessionView& view);

  std::uint64_t serial_ = 0;
  std::uint64_t input_serial_ = 0;
  std::vector<InputFacts> inputs_;  // facts of the open meshes
  std::vector<Known> known_;        // frames of the last view, and those computed at rest since
  Summaries summaries_;
  Judgements judgements_;
  Endings endings_;
};

/// A frame of any run with nothing but its qualities.
[[nodiscard]] Frame judged(Session& session, std::size_t run);

}  // namespace dmoscope
