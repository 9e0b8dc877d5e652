#pragma once
// Ambient occlusion of a volume's picture: corners and edges are a little darker. Only for sources of this module.

#include "render/framebuffer.h"
#include "render/gl.h"
#include "render/orbit_camera.h"
#include "render/style.h"

namespace dmoscope::render {

class OcclusionPainter {
 public:
  OcclusionPainter();
  /// Distance that it looks around a pixel, in whole pixels: a part of a picture must be drawn so much wider to fit its neighbours.
  /// `viewport`: size of the whole picture.
  [[nodiscard]] static int reach(Vec2<double> viewport, const Style& style);
  /// Darkens the colours of `target` by its depths, in corners by kMostDarkened at most, along sharp edges by kEdgeDarkened; the background
  /// stays. `projection`: the one that it was drawn with.
  void darken(Framebuffer& target, const Projection& projection, int reach, const Style& style) const;

 private:
  Program program_;
  Handle<DeleteVertexArray> nothing_;
  Handle<DeleteFramebuffer> colours_;  // colours of a target without its depths, which are read
};

}  // namespace dmoscope::render
