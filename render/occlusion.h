#pragma once
// Depth of a volume's picture without a lamp: what lies in corners and along edges is a little darker. Only for sources of this room.

#include "render/framebuffer.h"
#include "render/gl.h"
#include "render/orbit_camera.h"
#include "render/style.h"

namespace dmoscope::render {

class OcclusionPainter {
 public:
  OcclusionPainter();
  /// How far around a pixel it looks, in whole pixels: so much wider a part of a picture must be drawn to fit its neighbours. `viewport`:
  /// of the whole picture.
  [[nodiscard]] static int reach(Vec2<double> viewport, const Style& style);
  /// Darkens the colours of `target` by its depths, in corners by kMostDarkened at most, along sharp edges by kEdgeDarkened; the background
  /// stays. `projection`: that it was drawn with.
  void darken(Framebuffer& target, const Projection& projection, int reach, const Style& style) const;

 private:
  Program program_;
  Handle<DeleteVertexArray> nothing_;
  Handle<DeleteFramebuffer> colours_;  // of a target, without its depths, which are read
};

}  // namespace dmoscope::render
