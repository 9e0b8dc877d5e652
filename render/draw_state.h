#pragma once
// What drawing changes of OpenGL's state. Only for sources of this module.

#include "core/base/vec.h"
#include "render/framebuffer.h"
#include "render/gl.h"
#include "render/style.h"

namespace dmoscope::render {

/// Keeps what a draw changes and others may rely on: the bound framebuffer and the viewport.
class TargetGuard {
 public:
  TargetGuard();
  ~TargetGuard();
  TargetGuard(const TargetGuard&) = delete;
  TargetGuard& operator=(const TargetGuard&) = delete;

 private:
  GLint draw_ = 0, read_ = 0, viewport_[4] = {0, 0, 0, 0};
};

/// In pixels.
[[nodiscard]] Vec2<double> size_of(const Framebuffer& target);
/// Fills with the background.
void clear(Framebuffer& target, const Style& style);
/// From here on elements cover each other by depth.
void begin_elements();
/// From here on marks are blended over each other.
void begin_marks();

}  // namespace dmoscope::render
