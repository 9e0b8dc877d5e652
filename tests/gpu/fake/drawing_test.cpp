// Pictures written into OpenGL's buffers by a device.

#include <thread>

#include "core/view/frame_builder.h"
#include "gpu/accelerator.h"
#include "gpu/gl_interop.h"
#include "render/framebuffer.h"
#include "render/planar_scene.h"
#include "tests/gpu/fake/opengl.h"
#include "tests/smooth/zoo.h"

namespace dmoscope::gpu::fake {
namespace {

using ::testing::HasSubstr;

class FakeDrawing : public WithOpenGl {
 protected:
  void open() {
    session = std::make_unique<Session>(2U, make_accelerator(), Backend::Cuda);
    Progress progress;
    session->open(dmoscope::testing::lattice(12, 0.7, 71, dmoscope::testing::Cells::Mixed), progress);
    session->active().iterate(2, progress);
  }
  std::shared_ptr<const DevicePicture> picture() { return session->active().picture(Metric::MeanRatio); }
  [[nodiscard]] Drawn buffers() { return {session->active().input().mesh.vertex_count(), session->active().input().mesh.elements.size()}; }
  void TearDown() override {
    session.reset();
    WithOpenGl::TearDown();
  }
  std::unique_ptr<Session> session;
};

TEST_F(FakeDrawing, WhatIsInTheWay) {
  EXPECT_EQ(gl_obstacle(0), "");
  set_up({.devices = std::vector<FakeDevice>(2), .drawing = 1, .gl = &gl});
  EXPECT_EQ(gl_obstacle(0), "OpenGL draws on CUDA device 1, but device 0 smooths; with CUDA_VISIBLE_DEVICES=1 one does both");
  EXPECT_EQ(gl_obstacle(1), "");
  set_up({.drawing = -1, .gl = &gl});
  EXPECT_THAT(gl_obstacle(0), HasSubstr("OpenGL does not draw on a device of CUDA"));
  EXPECT_THAT(gl_obstacle(0), HasSubstr("__NV_PRIME_RENDER_OFFLOAD=1 __GLX_VENDOR_LIBRARY_NAME=nvidia")) << "as on many a laptop";
  set_up({});
  EXPECT_THAT(gl_obstacle(0), HasSubstr("OpenGL does not draw on a device of CUDA"));
  set_up({.gl = &gl});
  std::string elsewhere;
  std::thread([&] { elsewhere = gl_obstacle(0); }).join();  // without a current context
  EXPECT_THAT(elsewhere, HasSubstr("OpenGL does not draw on a device of CUDA"));
}

TEST_F(FakeDrawing, TheBytesAreThoseOfTheHostsPath) {
  open();
  const auto first = picture();
  const Drawn drawn = buffers();
  const Vec2<double> origin{3.25, -1.5};
  std::vector<Vec2<float>> points(drawn.points().size());
  std::vector<float> shades(drawn.shades().size());
  const auto expect_same = [&](const DevicePicture& shown) {
    shown.download(points, shades, origin);
    const auto there = drawn.points();
    for (std::size_t v = 0; v < points.size(); ++v) {
      ASSERT_EQ(points[v].x, there[v].x) << v;
      ASSERT_EQ(points[v].y, there[v].y) << v;
    }
    EXPECT_EQ(shades, drawn.shades());
  };
  const auto target = first->make_target(drawn.points_name(), drawn.shades_name());
  const std::uint64_t before = first->bytes_to_host();
  first->write(*target, origin);
  EXPECT_EQ(first->bytes_to_host(), before);
  expect_same(*first);
  Progress progress;
  session->active().iterate(1, progress);
  const auto second = picture();
  for (int again = 0; again < 3; ++again) second->write(*target, origin);
  expect_same(*second);
  first->write(*target, origin);
  expect_same(*first);
}

TEST_F(FakeDrawing, BuffersThatAreTooSmallAreRefused) {
  open();
  const auto shown = picture();
  const Drawn drawn(4, 4);
  const auto target = shown->make_target(drawn.points_name(), drawn.shades_name());
  EXPECT_THROW(shown->write(*target, {}), DeviceError);
}

/// The window's scene, written by the device, and through the host if another device draws.
TEST_F(FakeDrawing, TheSceneIsThatOfAWholeFrame) {
  for (const int drawing : {0, -1}) {
    set_up({.drawing = drawing, .gl = &gl});
    open();
    FrameBuilder builder;
    const auto light = builder.build(*session, FrameDetail::Live)->frame;
    ASSERT_NE(light->device, nullptr);
    const auto whole = builder.build(*session)->frame;
    {
      render::PlanarScene scene;
      render::Framebuffer target(160, 160);
      const auto look = [&](const std::shared_ptr<const Frame>& frame) {
        scene.show(frame);
        scene.draw(target, render::Camera2D::fit(scene.bounds(), {160, 160}), render::Style::dark());
        return target.read_pixels().rgba;
      };
      const auto wanted = look(whole);
      EXPECT_EQ(look(light), wanted);
      EXPECT_EQ(scene.source(), drawing == 0 ? render::Source::Device : render::Source::HostCopy);
      EXPECT_EQ(scene.device_trouble().empty(), drawing == 0) << scene.device_trouble();
    }
    session.reset();
    EXPECT_THAT(breaches(), ::testing::IsEmpty());
  }
}

/// Detection of errors between CUDA and OpenGL by the stand-ins.
class FakeDrawingRules : public WithOpenGl {
 protected:
  void TearDown() override { set_up({}); }
};
TEST_F(FakeDrawingRules, BuffersAreKnownNoLongerThanTheyLive) {
  auto drawn = std::make_unique<Drawn>(4, 4);
  auto target = std::make_unique<GlTarget>(0, drawn->points_name(), drawn->shades_name());
  drawn.reset();
  target.reset();
  EXPECT_THAT(breaches(), ::testing::Each(HasSubstr("after the buffer was deleted")));
  EXPECT_EQ(breaches().size(), 2U);
}
TEST_F(FakeDrawingRules, TheContextIsCurrentOnTheThread) {
  const Drawn drawn(4, 4);
  auto target = std::make_unique<GlTarget>(0, drawn.points_name(), drawn.shades_name());
  std::thread([&] { EXPECT_NO_THROW(target->fill(nullptr, nullptr, [](const GlTarget::Mapped&) {})); }).join();
  EXPECT_THAT(breaches(), ::testing::Each(HasSubstr("without the buffer's OpenGL context on this thread")));
  EXPECT_EQ(breaches().size(), 6U) << "two buffers are mapped, asked for and unmapped";
}
TEST_F(FakeDrawingRules, NothingIsMappedTwice) {
  const Drawn drawn(4, 4);
  GlTarget target(0, drawn.points_name(), drawn.shades_name());
  target.fill(nullptr, nullptr,
              [&](const GlTarget::Mapped&) { EXPECT_THROW(target.fill(nullptr, nullptr, [](const GlTarget::Mapped&) {}), DeviceError); });
  EXPECT_THAT(breaches(), ::testing::Each(HasSubstr("of what is mapped")));
  EXPECT_EQ(breaches().size(), 2U);
}

}  // namespace
}  // namespace dmoscope::gpu::fake
