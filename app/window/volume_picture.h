#pragma once
// A picture of a volume mesh, of its outside or of what is inside, without a window.

#include <span>
#include <string>

#include "app/window/picture.h"
#include "core/clipping/clipped_view.h"

namespace dmoscope::app {

/// What is seen of a volume mesh, and from where.
struct InsideLook {
  std::string clip;          // see parse_clip; empty: no plane
  ClippingView view{};       // its plane: the mode alone
  std::string from = "iso";  // see view_preset_table
  bool perspective = false;
  /// Whether anything of it is not the default.
  [[nodiscard]] bool asked_for() const { return !clip.empty() || view != ClippingView{} || from != "iso" || perspective; }
};

/// Throws UsageError for words that mean nothing, before anything is read.
void require_sense(const InsideLook& inside);

/// picture_of() a mesh in space.
[[nodiscard]] render::Image volume_picture(const InputMesh& input, std::span<const Vec3> positions, const PictureLook& look,
                                           const InsideLook& inside, const Progress& progress);

}  // namespace dmoscope::app
