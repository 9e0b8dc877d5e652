#pragma once
// Keeps the elements' colours up to date, on a thread of its own when that takes long.

#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <tuple>

#include "core/input/input_mesh.h"
#include "core/view/view.h"
#include "ui/analysis/element_colours.h"
#include "ui/state/view_state.h"

namespace dmoscope::ui {

/// Remembers the answer for the latest two meshes.
class Comparable {
 public:
  [[nodiscard]] bool operator()(const std::shared_ptr<const InputMesh>& a, const std::shared_ptr<const InputMesh>& b);

 private:
  std::weak_ptr<const InputMesh> a_, b_;
  bool same_ = false;
};

class ColourWorker {
 public:
  /// Starts working out the colours that the state wants of the session's frame. Costs nothing when they are there already. `reference`:
  /// frame that differences are taken from; null: there are no differences.
  void update(const ViewState& state, const SessionView& session, std::shared_ptr<const Frame> reference);
  /// Latest colours for the mesh and the wish, perhaps of an earlier frame while the next are worked out; null: quality is shown.
  [[nodiscard]] const std::shared_ptr<const ElementColours>& colours() const noexcept { return colours_; }
  /// Whether the colours belong to the frame.
  [[nodiscard]] bool settled() const noexcept { return !pending_.valid(); }

 private:
  /// Everything that the colours depend on: by, input, frame if positions count, reference, classes, size or what may move, map and its
  /// direction if there is an order.
  using Key = std::tuple<ColourBy, std::uint64_t, std::uint64_t, std::uint64_t, const void*, int, bool>;
  void take();

  Comparable comparable_;
  std::optional<Key> key_;  // key of the latest request
  std::shared_ptr<const ElementColours> colours_;
  std::future<std::shared_ptr<const ElementColours>> pending_;
  std::shared_ptr<const Colouring> classes_;  // kept, so that the key's pointer stays its own
  std::shared_ptr<const Domain> domain_;      // kept like classes_
  SharedVector<std::uint8_t> fixed_;          // kept like classes_
  std::shared_ptr<const JointCluster> hold_;  // kept like classes_
};

}  // namespace dmoscope::ui
