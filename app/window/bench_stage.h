#pragma once
// Drawing for measurements.

#include <memory>

#include "app/window/interop.h"
#include "render/planar_scene.h"

namespace dmoscope::app {

/// A scene with its framebuffer, on an OpenGL context of its own.
class BenchStage {
 public:
  BenchStage(const Acceleration& acceleration, int width, int height)
      : context_(headless_context_for(acceleration)), picture_(width, height) {
    scene_.draw_through_host(no_interop(acceleration, *context_));
  }
  void show(const std::shared_ptr<const Frame>& frame) {
    scene_.show(frame);
    if (first_) {
      const Vec2<double> viewport{static_cast<double>(picture_.width()), static_cast<double>(picture_.height())};
      camera_ = render::Camera2D::fit(scene_.bounds(), viewport);
      first_ = false;
    }
    scene_.draw(picture_, camera_, render::Style::dark());
    context_->finish();
  }
  [[nodiscard]] const render::Context& context() const { return *context_; }
  [[nodiscard]] const render::PlanarScene& scene() const { return scene_; }

 private:
  std::unique_ptr<render::Context> context_;
  render::Framebuffer picture_;
  render::PlanarScene scene_;
  render::Camera2D camera_;
  bool first_ = true;
};

}  // namespace dmoscope::app
