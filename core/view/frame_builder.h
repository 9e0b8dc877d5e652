#pragma once
// Makes the immutable pictures of a session that the engine publishes.

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

/// Whole: everything is in the frame. Live: what lives on a device stays there, see Frame. Quick: likewise, and what would take another
/// look at all elements is left to the next frame, see Frame::provisional.
enum class FrameDetail { Whole, Live, Quick };

class FrameBuilder {
 public:
  /// The session as it stands, with a frame of its active run, and what is watched besides. Qualities are computed with the session's
  /// pool. Throws DeviceError for the active run.
  [[nodiscard]] std::shared_ptr<const SessionView> build(Session& session, FrameDetail detail = FrameDetail::Whole,
                                                         std::span<const Watch> watched = {});
  /// Works out what takes long and nobody waits for, as long as `go_on`, which is asked every now and then, says so: what is watched but
  /// no longer kept, and what views show besides frames, percentiles and summaries of all runs. Returns whether there is something new to
  /// show. Throws DeviceError.
  bool work_at_rest(Session& session, std::span<const Watch> watched, const std::function<bool()>& go_on);
  /// The same of what takes seconds and comes after all else.
  bool work_long_at_rest(Session& session, const std::function<bool()>& go_on);
  /// The same of what comes last of all: trials of what could be done.
  bool try_at_rest(Session& session, const std::function<bool()>& go_on);

 private:
  /// What a frame is of: as long as it is the same, so is the frame.
  struct FrameKey {
    StandingRun at{};  // of no run: the input
    std::size_t index = Frame::kNoRun;
    Metric shown = Metric::MeanRatio;
    StandingRule rule{};  // of the input: what stays there, as for the active run
    [[nodiscard]] bool is(const FrameKey& other) const;
  };
  struct Known {
    FrameKey key;
    std::shared_ptr<const Frame> frame;
    bool wanted = true;  // in the view that is being built
  };
  /// What all frames of a mesh have in common.
  struct InputFacts {
    std::shared_ptr<const InputMesh> input;
    std::uint64_t serial = 0;
    std::map<Metric, std::shared_ptr<const InputSpread>> before;  // of the metrics shown so far
  };
  static const std::shared_ptr<const InputMesh>& input_of(Session& session, const FrameKey& key);
  static FrameKey key_of(Session& session, std::size_t run);
  /// Of the positions that the run had at the end of an iteration.
  static FrameKey key_of(Session& session, std::size_t run, std::uint64_t iteration);
  /// Provisional ones only where `detail` says so.
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
  std::vector<InputFacts> inputs_;  // of the meshes that are open
  std::vector<Known> known_;        // frames of the last view, and what was worked out at rest since
  Summaries summaries_;
  Judgements judgements_;
  Endings endings_;
};

/// A frame of any run, for its qualities alone.
[[nodiscard]] Frame judged(Session& session, std::size_t run);

}  // namespace dmoscope
