#pragma once
// OpenGL state that drawing changes. Only for sources of this module.

#include "core/base/vec.h"
#include "render/framebuffer.h"
#include "render/gl.h"
#include "render/style.h"

namespace dmoscope::render {

/// Keeps and restores what a draw changes and others may rely on: the bound framebuffer and the viewport.
class TargetGuard {
 public:
  TargetGuard();
  ~TargetGuard();
  TargetGuard(const TargetGuard&) = delete;
  TargetGuard& operator=(const TargetGuard&) = delete;

 private:
  GLint draw_ = 0, read_ = 0, viewport_[4] = {0, 0, 0, 0};
};

/// Width and height in pixels.
[[nodiscard]] Vec2<double> size_of(const Framebuffer& target);
/// Fills the target with the background.
void clear(Framebuffer& target, const Style& style);
/// Sets the state for elements: from here on they cover each other by depth.
void begin_elements();
/// Sets the state for marks: from here on they are blended over each other.
void begin_marks();

}  // namespace dmoscope::render
