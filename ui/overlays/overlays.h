#pragma once
// All that is drawn over the mesh of a viewport.

#include <string>
#include <vector>

#include "ui/overlays/overlay.h"

namespace dmoscope::ui {

/// Keeps what arrows and ghosts compare the mesh with.
class Overlays {
 public:
  Overlays();
  /// Once a frame: notices when a command has moved something. `busy`: more is to come.
  void update(const SessionView& session, bool busy);

  /// What is marked; `inspected`: a search that is looked into is shown here.
  [[nodiscard]] render::Marks marks(const Scenery& scenery, const SessionView& session, const render::Scene& scene,
                                    const render::Camera& camera, Vec2<double> viewport, bool inspected);
  /// What is shown, in words for the mesh's title: "next: class 2 of 7, 1,234 vertices"; empty when nothing is.
  [[nodiscard]] std::string note(const ViewState& state, const SessionView& session) const;

 private:
  /// Changes whenever the marks of the steady ones do.
  [[nodiscard]] std::string key(const OverlayInput& in, const MarkView& view) const;

  std::vector<OverlayPointer> of_moment_;         // made for every drawing
  std::vector<OverlayPointer> steady_;            // remade when something changes; they give way to a search in space
  std::shared_ptr<const Frame> rest_, previous_;  // where the last command ended, and the one before that moved something
  render::Marks kept_;                            // of the steady ones
  std::string kept_for_;
  bool too_much_ = false;  // in view to be looked through in a moment: steady ones were left out
};

}  // namespace dmoscope::ui
