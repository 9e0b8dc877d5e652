#pragma once
// Marks and notes over a mesh, besides its elements: each source has one overlay, or a few that belong together.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/joint/joint_clusters.h"
#include "core/reference/domain.h"
#include "core/view/view.h"
#include "render/marks.h"
#include "ui/analysis/derived.h"
#include "ui/analysis/inspection.h"
#include "ui/overlays/mark_view.h"
#include "ui/state/view_state.h"

namespace dmoscope::ui {

/// State that all viewports have in common.
struct Scenery {
  const ViewState& state;
  const Derived& derived;
  const Inspection& inspection;
  const InputMesh* active = nullptr;  // mesh that picks and selections belong to
};

/// Facts that overlays know of the mesh of a viewport.
struct OverlayInput {
  const ViewState& state;
  const SessionView& session;               // session whose frame is on the host
  std::shared_ptr<const Frame> previous{};  // the frame before the last command that moved something
  const Scenery* scenery = nullptr;         // null for those that need none
  const render::Scene* scene = nullptr;     // null for overlays that need none
  render::Camera camera{};                  // camera of the viewport
  bool inspecting = false;                  // whether a visit is inspected here
  bool searching = false;                   // whether its search is not yet done
  [[nodiscard]] const Frame& frame() const { return *session.frame; }
  [[nodiscard]] const InputMesh& input() const { return *frame().input; }
  [[nodiscard]] const RunView* run() const { return frame().run < session.runs.size() ? &session.runs[frame().run] : nullptr; }
  /// Whether it is the active mesh, or one whose ids mean the same.
  [[nodiscard]] bool is_active_mesh() const;
  /// The pick, if it belongs to this mesh; else nothing.
  [[nodiscard]] Picked picked() const;
  [[nodiscard]] bool marks_worst() const { return state.worst_marker && !frame().worst.empty() && !inspecting; }
  /// Colours of the run, for the overlay's lines.
  [[nodiscard]] Inks inks(int casing_alpha) const;
  [[nodiscard]] std::optional<std::span<const Vec3>> positions_of(Reference reference) const;
};

class Overlay {
 public:
  virtual ~Overlay() = default;
  /// Whether there is anything to draw.
  [[nodiscard]] virtual bool wanted(const OverlayInput& in) const = 0;
  virtual void make(const OverlayInput& in, const MarkView& view, render::Marks& marks) = 0;
  /// Whether it marks only what nothing hides, which takes a moment to find in space.
  [[nodiscard]] virtual bool needs_unhidden() const { return true; }
  /// Note about the marks for the mesh's title; empty for none. Asked after make(), or without it if there is nothing to make.
  [[nodiscard]] virtual std::string note(const OverlayInput& /*in*/) const { return {}; }
};
using OverlayPointer = std::unique_ptr<Overlay>;

[[nodiscard]] inline render::Rgba solid(render::Rgb c, int alpha = 255) { return {c.r, c.g, c.b, static_cast<std::uint8_t>(alpha)}; }

// All overlays.
[[nodiscard]] OverlayPointer picked_overlay();      // the picked element or vertex, and its elements
[[nodiscard]] OverlayPointer worst_overlay();       // the worst element, and those that are inverted only inside
[[nodiscard]] OverlayPointer inverted_overlay();    // inverted elements that are too small to be seen
[[nodiscard]] OverlayPointer ghost_overlay();       // edges at their old places
[[nodiscard]] OverlayPointer arrow_overlay();       // arrows from the old to the present places of vertices
[[nodiscard]] OverlayPointer feature_overlay();     // curves along which vertices slide, and the edge under the mouse
[[nodiscard]] OverlayPointer next_class_overlay();  // vertices that move next
[[nodiscard]] OverlayPointer flash_overlay();       // the vertex of a step of a single visit, for a moment
[[nodiscard]] OverlayPointer holder_overlay();      // elements and forces that hold the minimum
[[nodiscard]] OverlayPointer selection_overlay();   // selected vertices
[[nodiscard]] OverlayPointer inspection_overlay();  // the search of a vertex
[[nodiscard]] OverlayPointer target_overlay();      // targets of picked elements
[[nodiscard]] OverlayPointer size_point_overlay();  // the point of a size function

/// Adds curves and feature edges along which vertices slide as lines, and held vertices as squares, as far as they are seen.
void add_features(render::Marks& marks, const MarkView& view, const Domain& domain, std::span<const Vec3> positions, Inks inks);

/// The joint move that holds the minimum of the frame on show; null: not known, or not wanted.
[[nodiscard]] std::shared_ptr<const JointCluster> hold_of(const OverlayInput& in);

/// Inverted elements, ascending; if they are too many for marks, an even choice of them. None of a frame that is on a device.
[[nodiscard]] std::vector<Index> inverted_elements(const Frame& frame);
/// Adds diamonds for those of `elements` that are smaller in the picture, no two in one place, so that the surroundings stay visible.
void add_inverted(render::Marks& marks, const MarkView& view, const Frame& frame, std::span<const Index> elements);
/// Adds a diamond at a point of the scene.
void add_diamond(render::Marks& marks, Vec3 at, float diameter, const render::Style& style);
/// Adds marks for those of the frame's worst elements that are inverted only inside, at the place of the least Jacobian.
void add_inverted_inside(render::Marks& marks, const MarkView& view, const Frame& frame, const render::Style& style);

/// The picked element, or those around the picked vertex.
[[nodiscard]] std::vector<Index> picked_elements(const OverlayInput& in);
/// Adds for each element that has a target by `metric` an ellipse of the target's shape and direction, as large as the element, with its
/// longer axis (in space the three ellipses of an ellipsoid); and, thinner, the ellipse of the element itself. None for curved surfaces, or
/// if the frame is not on the host.
void add_targets(render::Marks& marks, const ScenePoints& points, const Frame& frame, Metric metric, std::span<const Index> elements);

}  // namespace dmoscope::ui
