#pragma once
// Keeps what elements are coloured by up to date, on a thread of its own where that takes long.

#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <tuple>

#include "core/view/view.h"
#include "ui/analysis/comparable.h"
#include "ui/analysis/element_colours.h"
#include "ui/state/view_state.h"

namespace dmoscope::ui {

class ColourWorker {
 public:
  /// Asks for what the state wants of the session's frame. Costs nothing when it is there already.
  /// `reference`: what differences are taken from; null: there are none to be had.
  void update(const ViewState& state, const SessionView& session, std::shared_ptr<const Frame> reference);
  /// The latest that fit the mesh and the wish, perhaps of an earlier frame while the next are worked out; null: quality is shown.
  [[nodiscard]] const std::shared_ptr<const ElementColours>& colours() const noexcept { return colours_; }
  /// Whether they are those of the frame.
  [[nodiscard]] bool settled() const noexcept { return !pending_.valid(); }

 private:
  /// What the colours depend on: by, input, frame where positions count, reference, classes, size or what may move, map and its direction
  /// where there is an order.
  using Key = std::tuple<ColourBy, std::uint64_t, std::uint64_t, std::uint64_t, const void*, int, bool>;
  void take();

  Comparable comparable_;
  std::optional<Key> key_;  // of what was asked for last
  std::shared_ptr<const ElementColours> colours_;
  std::future<std::shared_ptr<const ElementColours>> pending_;
  std::shared_ptr<const Colouring> classes_;  // kept, so that the key's pointer stays its own
  std::shared_ptr<const Domain> domain_;      // likewise
  SharedVector<std::uint8_t> fixed_;          // likewise
  std::shared_ptr<const JointCluster> hold_;  // likewise
};

}  // namespace dmoscope::ui
