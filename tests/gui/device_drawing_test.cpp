// Writing of a CUDA device into OpenGL's buffers. Skipped without such a device; tests/render/device_test.cpp has the rest.
#include <memory>

#include <glad/gl.h>
#include <gtest/gtest.h>

#include "app/window/interop.h"
#include "core/session/session.h"
#include "core/view/frame_builder.h"
#include "gpu/accelerator.h"
#include "render/framebuffer.h"
#include "render/planar_scene.h"

namespace dmoscope::app {
namespace {

class CudaDrawing : public testing::Test {
 protected:
  void SetUp() override {
    acceleration = gpu::make_accelerator();
    if (!acceleration.accelerator) GTEST_SKIP() << "needs a CUDA device: " << acceleration.reason;
    try {
      context = headless_context_for(acceleration);
    } catch (const Error& error) {
      GTEST_SKIP() << "no OpenGL without a screen: " << error.what();
    }
    session = std::make_unique<Session>(2U, acceleration, Backend::Cuda);
    Progress progress;
    session->open(source_mesh(), progress);
    session->active().iterate(2, progress);
    light = builder.build(*session, FrameDetail::Live)->frame;
    whole = builder.build(*session)->frame;
    ASSERT_NE(light->device, nullptr);
  }
  /// A mesh of two kinds of elements, some turned over.
  static Mesh source_mesh() {
    constexpr Index kSide = 60;
    Mesh mesh;
    for (Index j = 0; j <= kSide; ++j)
      for (Index i = 0; i <= kSide; ++i) mesh.positions.push_back({500000.0 + i + (i * j % 7 == 3 ? 0.8 : 0.0), 4000000.0 + j, 0.0});
    for (Index j = 0; j < kSide; ++j)
      for (Index i = 0; i < kSide; ++i) {
        const Index a = j * (kSide + 1) + i, b = a + 1, d = a + kSide + 1, c = d + 1;
        const Index cell[] = {a, b, c, d}, first[] = {a, b, c}, second[] = {a, c, d};
        if (i < kSide / 2) {
          mesh.elements.add(ElementKind::Quadrilateral, cell);
        } else {
          mesh.elements.add(ElementKind::Triangle, first);
          mesh.elements.add(ElementKind::Triangle, second);
        }
      }
    return mesh;
  }

  Acceleration acceleration;
  std::unique_ptr<render::Context> context;
  std::unique_ptr<Session> session;
  FrameBuilder builder;
  std::shared_ptr<const Frame> light, whole;
};

TEST_F(CudaDrawing, ThePictureOfALightFrameIsThatOfTheWholeOne) {
  render::PlanarScene scene;
  scene.draw_through_host(no_interop(acceleration, *context));
  render::Framebuffer target(640, 640);
  const auto picture = [&](const std::shared_ptr<const Frame>& frame) {
    scene.show(frame);
    scene.draw(target, render::Camera2D::fit(scene.bounds(), {640, 640}), render::Style::dark());
    return target.read_pixels();
  };
  const render::Image wanted = picture(whole);
  const render::Image got = picture(light);
  std::printf("drawn %s\n", scene.source() == render::Source::Device ? "from the device" : scene.device_trouble().c_str());
  EXPECT_NE(scene.source(), render::Source::Unreachable);
  EXPECT_EQ(got.rgba, wanted.rgba);
}

TEST_F(CudaDrawing, WhatIsReadBackIsWhatTheDeviceTells) {
  if (const std::string why = no_interop(acceleration, *context); !why.empty()) GTEST_SKIP() << "no interop here: " << why;
  GLuint buffers[2] = {0, 0};
  glCreateBuffers(2, buffers);
  std::vector<Vec2<float>> points(light->vertex_count()), written_points(points.size());
  std::vector<float> shades(light->element_count()), written_shades(shades.size());
  const auto point_bytes = static_cast<GLsizeiptr>(std::as_bytes(std::span(points)).size());
  const auto shade_bytes = static_cast<GLsizeiptr>(std::as_bytes(std::span(shades)).size());
  glNamedBufferStorage(buffers[0], point_bytes, nullptr, GL_DYNAMIC_STORAGE_BIT);
  glNamedBufferStorage(buffers[1], shade_bytes, nullptr, GL_DYNAMIC_STORAGE_BIT);
  const Vec2<double> origin{500030, 4000030};
  const std::uint64_t before = light->device->bytes_to_host();
  {
    const auto target = light->device->make_target(buffers[0], buffers[1]);
    for (int repeat = 0; repeat < 3; ++repeat) light->device->write(*target, origin);
    glGetNamedBufferSubData(buffers[0], 0, point_bytes, written_points.data());
    glGetNamedBufferSubData(buffers[1], 0, shade_bytes, written_shades.data());
  }
  EXPECT_EQ(light->device->bytes_to_host(), before) << "writing goes from device to device";
  light->device->download(points, shades, origin);
  for (std::size_t v = 0; v < points.size(); ++v) {
    ASSERT_EQ(written_points[v].x, points[v].x) << v;
    ASSERT_EQ(written_points[v].y, points[v].y) << v;
    ASSERT_EQ(points[v].x, static_cast<float>(whole->positions[v].x - origin.x)) << v;
  }
  EXPECT_EQ(written_shades, shades);
  for (Index e = 0; e < light->element_count(); ++e) ASSERT_EQ(shades[e], shade_of(whole->quality[e], whole->inverted[e] != 0)) << e;
  glDeleteBuffers(2, buffers);
}

}  // namespace
}  // namespace dmoscope::app
