#pragma once
// All overlays of the mesh of a viewport.

#include <string>
#include <vector>

#include "ui/overlays/overlay.h"

namespace dmoscope::ui {

/// All overlays, with the frames that arrows and ghosts compare the mesh with.
class Overlays {
 public:
  Overlays();
  /// Notices when a command has moved something; to be called once a frame. `busy`: more is to come.
  void update(const SessionView& session, bool busy);

  /// Marks over the mesh; `inspected`: the inspected search is shown here.
  [[nodiscard]] render::Marks marks(const Scenery& scenery, const SessionView& session, const render::Scene& scene,
                                    const render::Camera& camera, Vec2<double> viewport, bool inspected);
  /// Note for the mesh's title: "next: class 2 of 7, 1,234 vertices"; empty when nothing is shown.
  [[nodiscard]] std::string note(const ViewState& state, const SessionView& session) const;

 private:
  /// Text that changes whenever the marks of the steady overlays do.
  [[nodiscard]] std::string key(const OverlayInput& in, const MarkView& view) const;

  std::vector<OverlayPointer> of_moment_;         // made for every drawing
  std::vector<OverlayPointer> steady_;            // remade when something changes; hidden by a search in space
  std::shared_ptr<const Frame> rest_, previous_;  // frame after the last command, and before the last one that moved something
  render::Marks kept_;                            // marks of the steady overlays
  std::string kept_for_;
  bool too_much_ = false;  // too much in view to be looked through in a moment: steady overlays were left out
};

}  // namespace dmoscope::ui
