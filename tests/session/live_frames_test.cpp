// Frames that are published while a run steps on a device.

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "core/engine/engine.h"
#include "core/view/patch.h"
#include "tests/support/fake_accelerator.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using testing::acceleration;
using testing::FakeDevice;
using testing::FakePictureDevice;

std::shared_ptr<FakeDevice> drawn_device() {
  auto device = std::make_shared<FakeDevice>();
  device->pictures = std::make_shared<FakePictureDevice>();
  return device;
}

/// Steps a run without end until one of its views is as wanted, and cancels it; none if no view was.
template <class Wanted>
std::shared_ptr<const SessionView> view_while_running(Engine& engine, Wanted wanted) {
  engine.post("run 100000000");
  const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  std::shared_ptr<const SessionView> found;
  while (!found && std::chrono::steady_clock::now() < patience) {
    const auto view = engine.view();
    if (view->frame && engine.busy() && wanted(*view->frame)) found = view;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  engine.cancel();
  engine.wait_idle();
  return found;
}

TEST(LiveFrames, StayOnTheDeviceAndTheLastOneIsWhole) {
  const auto device = drawn_device();
  Engine engine(1, acceleration(device), Backend::Cuda);
  engine.post("generate annulus 3000");
  engine.wait_idle();
  const auto start = engine.view();
  ASSERT_NE(start->frame, nullptr);
  EXPECT_EQ(start->frame->device, nullptr) << "nothing runs";
  EXPECT_EQ(start->runs[0].backend, Backend::Cuda);

  const auto live = view_while_running(engine, [](const Frame& frame) {
    return frame.device != nullptr && frame.moment.visits == 0;  // on a slow machine a frame may show an unfinished iteration
  });
  ASSERT_NE(live, nullptr);
  const Frame& light = *live->frame;
  EXPECT_TRUE(light.positions.empty() && light.quality.empty() && light.inverted.empty());
  EXPECT_GT(light.moment, Moment{});
  EXPECT_GT(light.serial, start->frame->serial);
  const Statistics& recorded = live->runs[0].records.at(light.moment.iteration).statistics;
  EXPECT_EQ(light.shown_statistics.minimum, recorded.minimum);
  EXPECT_EQ(light.shown_statistics.mean, recorded.mean);
  ASSERT_EQ(light.worst.size(), 1U);
  EXPECT_EQ(light.worst[0].element, recorded.worst_element);
  EXPECT_EQ(light.worst[0].quality, recorded.minimum);
  EXPECT_EQ(light.before.counts, start->frame->before.counts);
  EXPECT_EQ(device->pictures->downloads, 0);

  const auto end = engine.view();
  EXPECT_EQ(end->frame->device, nullptr);
  EXPECT_EQ(end->frame->positions.size(), end->frame->vertex_count());
  // Values of a patch for the light frame are those of a run on the CPU at that iteration.
  Engine cpu(1, {}, Backend::Cpu);
  cpu.post("generate annulus 3000");
  cpu.post("run " + std::to_string(light.moment.iteration));
  cpu.wait_idle();
  const auto same = cpu.view();
  const Index elements[] = {light.worst[0].element, 7, 700};
  const Patch patch = patch_of(light, elements), other = patch_of(*same->frame, elements);
  EXPECT_EQ(patch.mesh.positions, other.mesh.positions);
  EXPECT_EQ(patch.vertices, other.vertices);
  for (Index k = 0; k < 3; ++k) {
    EXPECT_EQ(patch.quality(Metric::ScaledJacobian, k),
              element_quality(same->input->quality_context(), same->frame->positions, Metric::ScaledJacobian, elements[k]));
    EXPECT_EQ(patch.inverted(k), same->frame->inverted[elements[k]] != 0);
  }
}

TEST(LiveFrames, ASnapshotThatFailsBecomesAWholeFrameWithTheReason) {
  const auto device = drawn_device();
  device->pictures->can_snapshot = false;
  Engine engine(1, acceleration(device), Backend::Cuda);
  engine.post("generate annulus 500");
  engine.wait_idle();
  const auto live = view_while_running(engine, [](const Frame& frame) { return frame.moment > Moment{}; });
  ASSERT_NE(live, nullptr);
  EXPECT_EQ(live->frame->device, nullptr);
  EXPECT_EQ(live->frame->device_trouble, "no memory for a snapshot");
  EXPECT_EQ(live->frame->positions.size(), live->frame->vertex_count());
  EXPECT_EQ(live->runs[0].backend, Backend::Cuda) << "the run goes on where it is";
  EXPECT_EQ(engine.view()->frame->device_trouble, "");
}

TEST(LiveFrames, ADeviceLostAtTheEndLeavesAFrameOfTheHost) {
  const auto device = drawn_device();
  Engine engine(1, acceleration(device), Backend::Cuda);
  engine.post("generate annulus 500");
  engine.post("history 0");  // nothing is copied to the host while it runs
  engine.wait_idle();
  device->fail_at_store = device->stores + 1;
  const auto live = view_while_running(engine, [](const Frame& frame) { return frame.moment > Moment{}; });
  ASSERT_NE(live, nullptr);
  bool said = false;
  for (const Message& message : engine.take_messages()) said = said || message.text.find("lost while copying") != std::string::npos;
  EXPECT_TRUE(said);
  const auto end = engine.view();
  EXPECT_EQ(end->frame->device, nullptr);
  EXPECT_EQ(end->runs[0].backend, Backend::Cpu);
  EXPECT_EQ(end->frame->moment, end->runs[0].moment);
  const Statistics& recorded = end->runs[0].records.at(end->frame->moment.iteration).statistics;
  EXPECT_EQ(
      compute_statistics(end->input->quality_context(), end->frame->positions, Metric::MeanRatio, end->runs[0].fixed, nullptr).minimum,
      recorded.minimum);
}

TEST(LiveFrames, ComeAsOftenAsAScreenShowsThemAndNeverForMoreThanASixthOfTheTime) {
  using std::chrono::milliseconds;
  EXPECT_LE(publication_pause(true, milliseconds(1)) + milliseconds(1), milliseconds(1000 / 60));
  EXPECT_EQ(publication_pause(true, milliseconds(40)), milliseconds(200));
  EXPECT_EQ(publication_pause(false, milliseconds(1)), milliseconds(100));
  EXPECT_EQ(publication_pause(false, milliseconds(40)), milliseconds(200));
}

}  // namespace
}  // namespace dmoscope
