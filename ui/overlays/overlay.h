#pragma once
// What is drawn over a mesh besides its elements: each source has one overlay, or a few that belong together, with marks and words.

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "core/joint/joint_clusters.h"
#include "core/reference/domain.h"
#include "core/view/view.h"
#include "render/marks.h"
#include "ui/analysis/derived.h"
#include "ui/analysis/inspection.h"
#include "ui/overlays/cased_lines.h"
#include "ui/overlays/mark_view.h"
#include "ui/state/view_state.h"

namespace dmoscope::ui {

/// What all viewports have in common.
struct Scenery {
  const ViewState& state;
  const Derived& derived;
  const Inspection& inspection;
  const InputMesh* active = nullptr;  // that picks and selections are of
};

/// What overlays know of the mesh of a viewport.
struct OverlayInput {
  const ViewState& state;
  const SessionView& session;               // whose frame is on the host
  std::shared_ptr<const Frame> previous{};  // the frame before the last command that moved something
  const Scenery* scenery = nullptr;         // null for those that need none
  const render::Scene* scene = nullptr;     // likewise
  render::Camera camera{};                  // that it is seen by
  bool inspecting = false;                  // a visit is looked into here
  bool searching = false;                   // and not yet done
  [[nodiscard]] const Frame& frame() const { return *session.frame; }
  [[nodiscard]] const InputMesh& input() const { return *frame().input; }
  [[nodiscard]] const RunView* run() const { return frame().run < session.runs.size() ? &session.runs[frame().run] : nullptr; }
  /// Whether it is the active mesh, or one whose ids mean the same.
  [[nodiscard]] bool is_active_mesh() const;
  /// Nothing on another mesh than the one that the pick is of.
  [[nodiscard]] Picked picked() const;
  [[nodiscard]] bool marks_worst() const { return state.worst_marker && !frame().worst.empty() && !inspecting; }
  /// Of the run; lines of overlays are in it.
  [[nodiscard]] Inks inks(int casing_alpha) const;
  [[nodiscard]] std::optional<std::span<const Vec3>> positions_of(Reference reference) const;
};

class Overlay {
 public:
  virtual ~Overlay() = default;
  /// Whether there is anything to be drawn.
  [[nodiscard]] virtual bool wanted(const OverlayInput& in) const = 0;
  virtual void make(const OverlayInput& in, const MarkView& view, render::Marks& marks) = 0;
  /// Whether it marks what nothing hides, which takes a moment to be found in space.
  [[nodiscard]] virtual bool needs_unhidden() const { return true; }
  /// What is shown, in words for the mesh's title; empty for nothing. Asked after make(), and where nothing is made.
  [[nodiscard]] virtual std::string note(const OverlayInput& /*in*/) const { return {}; }
};
using OverlayPointer = std::unique_ptr<Overlay>;

[[nodiscard]] inline render::Rgba solid(render::Rgb c, int alpha = 255) { return {c.r, c.g, c.b, static_cast<std::uint8_t>(alpha)}; }

// Each in a source of its own.
[[nodiscard]] OverlayPointer picked_overlay();      // what is picked, and its elements
[[nodiscard]] OverlayPointer worst_overlay();       // the worst element, and those that only their inside inverts
[[nodiscard]] OverlayPointer inverted_overlay();    // inverted elements that are too small to be seen
[[nodiscard]] OverlayPointer ghost_overlay();       // edges as they were
[[nodiscard]] OverlayPointer arrow_overlay();       // from where vertices were to where they are
[[nodiscard]] OverlayPointer feature_overlay();     // curves along which vertices slide, and the edge that is pointed at
[[nodiscard]] OverlayPointer next_class_overlay();  // vertices that move next
[[nodiscard]] OverlayPointer flash_overlay();       // the vertex of a step of one, for a moment
[[nodiscard]] OverlayPointer holder_overlay();      // what holds the minimum
[[nodiscard]] OverlayPointer selection_overlay();   // selected vertices
[[nodiscard]] OverlayPointer inspection_overlay();  // the search of a vertex
[[nodiscard]] OverlayPointer target_overlay();      // what picked elements are wished to be
[[nodiscard]] OverlayPointer size_point_overlay();  // the point of a size function

}  // namespace dmoscope::ui
