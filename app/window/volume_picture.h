#pragma once
// Pictures of volume meshes, from outside or of the inside, without a window.

#include <span>
#include <string>

#include "app/window/picture.h"
#include "core/clipping/clipped_view.h"

namespace dmoscope::app {

/// The visible part of a volume mesh, and the view's direction.
struct InsideLook {
  std::string clip;          // see parse_clip; empty: no plane
  ClippingView view{};       // the mode alone; the plane is that of `clip`
  std::string from = "iso";  // see view_preset_table
  bool perspective = false;
  /// Whether any member differs from its default.
  [[nodiscard]] bool asked_for() const { return !clip.empty() || view != ClippingView{} || from != "iso" || perspective; }
};

/// Throws UsageError for words without meaning, before anything is read.
void require_sense(const InsideLook& inside);

/// Draws a mesh in space: see picture_of().
[[nodiscard]] render::Image volume_picture(const InputMesh& input, std::span<const Vec3> positions, const PictureLook& look,
                                           const InsideLook& inside, const Progress& progress);

}  // namespace dmoscope::app
