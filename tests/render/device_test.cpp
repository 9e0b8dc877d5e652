// Frames whose positions and qualities stay on a device: the pixels, marks and picks of whole frames, by either path.
#include <map>

#include <glad/gl.h>

#include "core/base/progress.h"
#include "fixture.h"
#include "tests/support/fake_picture.h"
#include "tests/support/picture_difference.h"

namespace dmoscope::render {
namespace {

using testing::FakePictureDevice;
using testing::light_frame;
using testing::whole_frame;

class Device : public WithContext {
 protected:
  void SetUp() override {
    WithContext::SetUp();
    device->fill = [](std::uint32_t buffer, std::span<const std::byte> data) {
      glNamedBufferSubData(buffer, 0, static_cast<GLsizeiptr>(data.size()), data.data());
      EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    };
  }
  /// The sheet far from the origin, with some vertices moved so far that elements turn over.
  std::shared_ptr<Frame> sheet(std::uint64_t serial, double push, std::uint64_t input_serial = 1, int columns = 14) {
    auto& input = inputs[input_serial];
    if (!input) {
      Mesh mesh = wavy_sheet(columns, 9);
      for (Vec3& p : mesh.positions) p = Vec3{500000, 4000000, 0} + 12.0 * p;
      Progress progress;
      input = prepare_input(std::move(mesh), "sheet.vtk", Need::Smoothing, progress);
    }
    std::vector<Vec3> positions = input->mesh.positions;
    for (std::size_t v = 0; v < positions.size(); v += 7) positions[v].x += push;
    return whole_frame(input, positions, Metric::MeanRatio, serial, input_serial);
  }
  Image look(const Marks& marks = {}) {
    Style style = Style::dark();
    style.vertices = dots;
    return picture(camera, style, marks);
  }

  const Camera2D camera = unit_camera({500000 + 84, 4000000 + 54});
  std::shared_ptr<FakePictureDevice> device = std::make_shared<FakePictureDevice>();
  std::map<std::uint64_t, std::shared_ptr<const InputMesh>> inputs;
  bool dots = false;
};

TEST_F(Device, ALightFrameLooksLikeTheWholeOne) {
  const auto whole = sheet(2, 17);
  ASSERT_GT(whole->shown_statistics.inverted, 0U);
  const Marks marks{.elements = {3, 20}, .vertices = {8, 30}, .worst = whole->worst.front().element};
  scene->show(sheet(1, 0));
  const Image before = look(marks);
  scene->show(whole);
  const Image wanted = look(marks);
  EXPECT_NE(wanted.rgba, before.rgba) << "the vertices moved";
  scene->show(sheet(3, 0));
  EXPECT_EQ(scene->source(), Source::Host);
  auto light = light_frame(*whole, device);
  light->serial = 4;
  EXPECT_TRUE(scene->show(light));
  EXPECT_EQ(scene->source(), Source::Device);
  EXPECT_EQ(scene->device_trouble(), "");
  EXPECT_EQ(look(marks).rgba, wanted.rgba);
  EXPECT_EQ(device->writes, 1);
  EXPECT_EQ(device->downloads, 0) << "nothing went through the host";
  EXPECT_LT(device->positions_told, 20U) << "but the corners of what is marked";
}

TEST_F(Device, TheFirstFrameOfAMeshMayBeLight) {
  const auto whole = sheet(2, 17);
  scene->show(whole);
  const Image wanted = look();
  scene->show(nullptr);
  EXPECT_TRUE(scene->show(light_frame(*whole, device)));
  EXPECT_FALSE(scene->bounds().empty());
  EXPECT_EQ(look().rgba, wanted.rgba);
}

TEST_F(Device, NothingThatMovedIsLeftOutWhereverOneLooks) {
  // Two blocks and more of elements; the light frame's vertices are outside the boxes of the frame before.
  const auto start = sheet(1, 0, 5, 400);
  auto moved = sheet(2, 0, 5, 400);
  for (Vec3& p : moved->positions) p.x += 300;
  moved = whole_frame(moved->input, moved->positions, moved->shown, 2, 5);
  const Camera2D far = unit_camera({500000 + 4700, 4000000 + 50});
  scene->show(moved);
  const Image wanted = picture(far, flat_style());
  scene->show(start);
  EXPECT_NE(picture(far, flat_style()).rgba, wanted.rgba);
  auto light = light_frame(*moved, device);
  light->serial = 3;
  scene->show(light);
  EXPECT_EQ(picture(far, flat_style()).rgba, wanted.rgba);
}

TEST_F(Device, WhatCannotWriteGoesThroughTheHostAndSaysWhy) {
  const auto whole = sheet(1, 17);
  scene->show(whole);
  const Image wanted = look();
  device->can_write = false;
  auto light = light_frame(*whole, device);
  light->serial = 2;
  EXPECT_TRUE(scene->show(light));
  EXPECT_EQ(scene->source(), Source::HostCopy);
  EXPECT_EQ(scene->device_trouble(), "this picture is drawn by another card");
  EXPECT_EQ(look().rgba, wanted.rgba);
  device->can_write = true;
  light = light_frame(*sheet(3, 5), device);
  scene->show(light);
  EXPECT_EQ(scene->source(), Source::HostCopy) << "what failed is not tried again and again";
  EXPECT_EQ(device->targets_made, 0);
  scene->show(sheet(4, 5));
  EXPECT_EQ(scene->source(), Source::Host);
}

TEST_F(Device, AWriteThatFailsLaterFallsBackToo) {
  const auto whole = sheet(1, 17);
  scene->show(whole);
  const Image wanted = look();
  scene->show(light_frame(*sheet(2, 3), device));
  ASSERT_EQ(scene->source(), Source::Device);
  device->can_write = false;
  auto light = light_frame(*whole, device);
  light->serial = 3;
  EXPECT_TRUE(scene->show(light));
  EXPECT_EQ(scene->source(), Source::HostCopy);
  EXPECT_EQ(scene->device_trouble(), "the buffers cannot be mapped");
  EXPECT_EQ(device->targets_alive, 0) << "the buffers are the device's no longer";
  EXPECT_EQ(look().rgba, wanted.rgba);
}

TEST_F(Device, ALostDeviceShowsNothingRatherThanWhatIsOld) {
  scene->show(sheet(1, 0));
  device->can_write = device->can_download = device->can_tell_positions = false;
  scene->show(light_frame(*sheet(2, 17), device));
  EXPECT_EQ(scene->source(), Source::Unreachable);
  EXPECT_EQ(scene->device_trouble(), "the device was lost");
  const Image empty = look({.elements = {3}, .vertices = {8}, .worst = 4});
  for (int x = 0; x < empty.width; ++x) ASSERT_TRUE(near_colour(empty.at(x, empty.height / 2), Style::dark().background));
  EXPECT_EQ(scene->pick(camera, kViewport, {100, 60}).element, kNoIndex);
  scene->show(sheet(3, 17));
  EXPECT_EQ(scene->source(), Source::Host);
  EXPECT_FALSE(near_colour(look().at(100, 60), Style::dark().background));
}

TEST_F(Device, PicksAndDotsAreOfWhatIsOnShow) {
  const auto whole = sheet(2, 17);
  dots = true;
  scene->show(whole);
  const Image wanted = look();
  std::vector<Pick> picks;
  for (double x = 5; x < kWidth; x += 10) picks.push_back(scene->pick(camera, kViewport, {x, 60}));
  scene->show(sheet(3, 0));
  auto light = light_frame(*whole, device);
  light->serial = 4;
  scene->show(light);
  EXPECT_EQ(device->downloads, 0);
  std::size_t k = 0;
  for (double x = 5; x < kWidth; x += 10, ++k) {
    const Pick pick = scene->pick(camera, kViewport, {x, 60});
    EXPECT_EQ(pick.element, picks[k].element) << x;
    EXPECT_EQ(pick.vertex, picks[k].vertex) << x;
    EXPECT_NEAR(pick.vertex_distance, picks[k].vertex_distance, 1e-4) << x;
  }
  EXPECT_TRUE(compare(look(), wanted).alike()) << "the dots' places were rounded to float";
  EXPECT_EQ(device->downloads, 1) << "once a frame, however much is asked";
  device->can_download = false;
  light = light_frame(*whole, device);
  light->serial = 5;
  scene->show(light);
  EXPECT_EQ(scene->pick(camera, kViewport, {100, 60}).element, kNoIndex) << "not what was there before";
  (void)look();
}

TEST_F(Device, BuffersAreMadeKnownOnceAMeshAndForgottenBeforeTheyDie) {
  for (std::uint64_t serial = 1; serial <= 4; ++serial) scene->show(light_frame(*sheet(serial, 2.0 * static_cast<double>(serial)), device));
  EXPECT_EQ(device->targets_made, 1);
  EXPECT_EQ(device->writes, 4);
  scene->show(sheet(5, 1));
  scene->show(light_frame(*sheet(6, 3), device));
  EXPECT_EQ(device->targets_made, 1) << "a whole frame in between changes nothing";
  scene->show(light_frame(*sheet(7, 3, 2, 20), device));
  EXPECT_EQ(device->targets_made, 2) << "another mesh has other buffers";
  EXPECT_EQ(device->targets_alive, 1);
  scene.reset();
  EXPECT_EQ(device->targets_alive, 0);
}

TEST_F(Device, AFailureIsForgottenWithItsMesh) {
  device->can_write = false;
  scene->show(light_frame(*sheet(1, 1), device));
  ASSERT_EQ(scene->source(), Source::HostCopy);
  device->can_write = true;
  scene->show(light_frame(*sheet(2, 1, 2, 20), device));
  EXPECT_EQ(scene->source(), Source::Device);
  EXPECT_EQ(scene->device_trouble(), "");
}

}  // namespace
}  // namespace dmoscope::render
