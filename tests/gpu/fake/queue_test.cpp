// Smoothing on the stand-ins: streams, graphs, events and copies of gpu/cuda_queue.cpp, and the processor's bits.

#include "core/mesh/generate.h"
#include "core/run/device_picture.h"
#include "core/run/run.h"
#include "gpu/accelerator.h"
#include "gpu/cuda_queue.h"
#include "gpu/task.h"
#include "tests/gpu/defined.h"
#include "tests/gpu/fake/fixture.h"
#include "tests/gpu/two_aims.h"
#include "tests/gpu/volumes.h"
#include "tests/smooth/zoo.h"

namespace dmoscope::gpu::fake {
namespace {

using namespace gpu::testing;
using dmoscope::testing::Cells;
using dmoscope::testing::lattice;

Subject subject_of(Mesh mesh) {
  Progress progress;
  return Subject(prepare_input(std::move(mesh), {}, Need::Smoothing, progress));
}
std::size_t count_of(const std::string& name) {
  const auto all = calls();
  return static_cast<std::size_t>(std::count(all.begin(), all.end(), name));
}

class FakeQueue : public OnStandIns {};

TEST_F(FakeQueue, SameBitsInThePlane) {
  const Subject subject = subject_of(lattice(18, 0.35, 95, Cells::Mixed));
  for (const int multiprocessors : {1, 132})  // classes fill the device, or are visited by teams
    for (const Metric metric : {Metric::MeanRatio, Metric::MinAngle}) {
      if (!dmoscope::testing::defined_for_all(metric, subject.input->mesh)) continue;
      SCOPED_TRACE(multiprocessors);
      set_up({.devices = {{.multiprocessors = multiprocessors}}, .together = metric == Metric::MinAngle});
      expect_same_visits(make_cuda_queue(0), subject, metric, {}, 3);
      EXPECT_EQ(count_of("cudaStreamBeginCapture"), 1U) << "an iteration is recorded once";
      EXPECT_EQ(count_of("cudaGraphLaunch"), 3U);
      EXPECT_THAT(leaks(), ::testing::IsEmpty());
      EXPECT_THAT(breaches(), ::testing::IsEmpty());
    }
}

/// Another phase needs another recording.
TEST_F(FakeQueue, SameBitsOfTwoAims) {
  const Subject subject = subject_of(lattice(8, 0.35, 95, Cells::Mixed));
  set_up({});
  expect_same_mean(make_cuda_queue(0), subject, Metric::MeanRatio, {});
  EXPECT_EQ(count_of("cudaStreamBeginCapture"), 4U) << "of five iterations two are of the same phase";
  expect_same_combinations(make_cuda_queue(0), subject, Metric::MeanRatio, {}, 4);
  expect_same_mean(make_cuda_queue(0), Subject(volume_samples(64).front().input), Metric::MeanRatio, {.grid_points = 4, .levels = 2});
  EXPECT_THAT(leaks(), ::testing::IsEmpty());
  EXPECT_THAT(breaches(), ::testing::IsEmpty());
}

TEST_F(FakeQueue, SameBitsOfAVolume) {
  const auto samples = volume_samples(64);
  const Subject subject(samples.back().input);
  expect_same_visits(make_cuda_queue(0), subject, Metric::MeanRatio, {}, 2);
}

/// Formulas are never compiled, since stand-ins load nothing: they are run step by step, and the description says so.
TEST_F(FakeQueue, SameBitsByFormulasAndTargets) {
  const Subject plane = subject_of(with_fields(lattice(8, 0.6, 97, Cells::Mixed))), volume(volume_samples(64).front().input);
  for (const int multiprocessors : {1, 132})
    for (const char* words : {"formula:smin/smax", "mean-ratio@input:1", "mean-ratio@field:m"}) {
      SCOPED_TRACE(words);
      set_up({.devices = {{.multiprocessors = multiprocessors}}});
      const Metric metric = parse_metric(words);
      expect_same_visits(make_cuda_queue(0), plane, metric, {}, 2);
      EXPECT_EQ(count_of("cudaStreamBeginCapture"), 1U);
      EXPECT_THAT(make_device_dmo(make_cuda_queue(0), plane.task(metric))->description(),
                  ::testing::StartsWith("the metric run step by step: "));
      EXPECT_THAT(leaks(), ::testing::IsEmpty());
      EXPECT_THAT(breaches(), ::testing::IsEmpty());
    }
  for (const char* words : {"formula:smin/smax", "mean-ratio@input:1"})
    expect_same_visits(make_cuda_queue(0), volume, parse_metric(words), {.grid_points = 4, .levels = 2}, 1);
}

/// On the second device, while the thread has used the first in between.
TEST_F(FakeQueue, EveryCallGoesToItsDevice) {
  set_up({.devices = std::vector<FakeDevice>(2)});
  const Subject subject = subject_of(lattice(8, 0.35, 96));
  const auto first = make_cuda_queue(0), second = make_cuda_queue(1);
  const auto here = make_device_dmo(first, subject.task(Metric::MeanRatio));
  const auto there = make_device_dmo(second, subject.task(Metric::MeanRatio));
  std::vector<Vec3> one = subject.input->mesh.positions, other = one;
  for (int i = 0; i < 2; ++i) EXPECT_EQ(here->visit(0, subject.visits(), one, nullptr), there->visit(0, subject.visits(), other, nullptr));
  here->store(one, nullptr);
  there->store(other, nullptr);
  for (Index v = 0; v < one.size(); ++v) ASSERT_TRUE(same(one[v], other[v])) << v;
}

TEST_F(FakeQueue, APictureIsASnapshotAndItsMemoryIsUsedAgain) {
  const Subject subject = subject_of(lattice(8, 0.35, 97));
  const auto queue = make_cuda_queue(0);
  const auto smoother = make_device_dmo(queue, subject.task(Metric::MeanRatio));
  std::vector<Vec3> positions = subject.input->mesh.positions;
  const std::vector<Vec3> before = positions;
  std::vector<Index> all(positions.size());
  for (Index v = 0; v < all.size(); ++v) all[v] = v;
  smoother->visit(0, subject.visits(), positions, nullptr);
  auto picture = smoother->picture(Metric::MeanRatio);
  smoother->store(positions, nullptr);
  const std::vector<Vec3> then = positions;
  smoother->visit(0, subject.visits(), positions, nullptr);
  smoother->store(positions, nullptr);
  const auto kept = picture->positions(all);
  std::vector<Vec2<float>> points(positions.size());
  std::vector<float> shades(subject.input->mesh.elements.size());
  picture->download(points, shades, {0.5, 0.25});
  for (Index v = 0; v < then.size(); ++v) {
    ASSERT_TRUE(same(kept[v], then[v])) << v;
    ASSERT_EQ(points[v].x, static_cast<float>(then[v].x - 0.5));
    ASSERT_EQ(points[v].y, static_cast<float>(then[v].y - 0.25));
  }
  for (Index e = 0; e < shades.size(); ++e)
    ASSERT_EQ(shades[e],
              shade_of(static_cast<float>(element_quality(subject.input->quality_context(), then, Metric::MeanRatio, e)), false));
  const Statistics expected = compute_statistics(subject.input->quality_context(), then, Metric::MeanRatio, subject.immovable, nullptr);
  EXPECT_TRUE(same(picture->summary().statistics.mean, expected.mean));
  const std::size_t pieces = count_of("cudaMalloc");
  for (int i = 0; i < 3; ++i) {
    picture = nullptr;
    picture = smoother->picture(Metric::MeanRatio);
  }
  EXPECT_EQ(count_of("cudaMalloc"), pieces);
  EXPECT_GT(count_of("cudaStreamWaitEvent"), 0U) << "it was read by another stream";
}

/// Longer than a piece of the memory in between, and no multiple of it.
TEST_F(FakeQueue, LongCopiesComeThroughWhole) {
  ThreadPool pool(3);
  for (const std::size_t size : {std::size_t{262144}, std::size_t{1048576}, std::size_t{3000001}}) {
    SCOPED_TRACE(size);
    const auto queue = make_cuda_queue(0);
    std::vector<std::uint32_t> sent(size), found(size);
    for (std::size_t i = 0; i < size; ++i) sent[i] = static_cast<std::uint32_t>(i * 2654435761U);
    const std::vector<std::uint32_t> copy = sent;
    Buffer<std::uint32_t> memory(queue, size);
    for (ThreadPool* threads : {static_cast<ThreadPool*>(nullptr), &pool}) {
      memory.clear();
      memory.upload(sent, threads);
      std::ranges::fill(sent, 0U);  // may be changed on return
      memory.download(found, threads);
      EXPECT_TRUE(found == copy);
      sent = copy;
    }
  }
}

TEST_F(FakeQueue, AFailureInALongCopyIsSaidAndNextTimeItComesThrough) {
  constexpr std::size_t kSize = 3000000;
  std::vector<std::uint32_t> sent(kSize), found(kSize);
  std::uint32_t value = 0;  // a new value each time: work left by a failure must not get into later values
  const auto both_ways = [&](Queue& queue, void* memory) {
    std::ranges::fill(sent, ++value);
    queue.upload(memory, sent.data(), kSize * 4, nullptr);
    queue.download(found.data(), memory, kSize * 4, nullptr);
  };
  bool failed = true;
  for (std::size_t n = 1; failed; ++n) {
    SCOPED_TRACE(n);
    set_up({});
    const auto queue = make_cuda_queue(0);
    void* const memory = queue->allocate(kSize * 4);
    fail_at(n, kOperatingSystem);
    try {
      both_ways(*queue, memory);
    } catch (const DeviceError& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr("OS call failed"));
    }
    failed = has_failed();
    fail_at(0, 0);
    std::ranges::fill(found, 0U);
    both_ways(*queue, memory);
    EXPECT_TRUE(found == sent);
    queue->release(memory);
    ASSERT_THAT(breaches(), ::testing::IsEmpty());
  }
}

/// Fans and other stars of a class are visited side by side, in the recording as well as without one.
TEST_F(FakeQueue, WhatDoesNotDependOnEachOtherIsAskedOfTwoStreams) {
  const auto waits_in = [](Cells cells, bool whole) {
    const Subject subject = subject_of(lattice(18, 0.35, 95, cells));
    std::size_t before = count_of("cudaStreamWaitEvent");
    const auto smoother = make_device_dmo(make_cuda_queue(0), subject.task(Metric::MeanRatio));  // makes the recording
    std::vector<Vec3> positions = subject.input->mesh.positions;
    if (!whole) before = count_of("cudaStreamWaitEvent");
    smoother->visit(0, whole ? subject.visits() : subject.visits() - 1, positions, nullptr);
    return count_of("cudaStreamWaitEvent") - before;
  };
  // Two waits come from the first use of the second stream.
  for (const bool whole : {true, false}) EXPECT_GT(waits_in(Cells::Mixed, whole), 2U) << whole;
}

/// A picture does not wait for the blocks of a smoothing kernel that have yet to begin.
TEST_F(FakeQueue, OnlyWhatReadsPicturesIsUrgent) {
  const Subject subject = subject_of(lattice(8, 0.35, 97));
  const Acceleration acceleration = make_accelerator();
  ASSERT_NE(acceleration.accelerator, nullptr) << acceleration.reason;
  const auto smoother = acceleration.accelerator->make_dmo(subject.task(Metric::MeanRatio));
  const std::vector<int> all = priorities();  // priorities of the accelerator, the run and its side, and the reader
  ASSERT_EQ(all.size(), 4U);
  EXPECT_LT(all[0], all[1]) << "the lower is the more urgent";
  EXPECT_EQ(all[1], all[3]);
}

/// Work of two queues is done in any order, except before a mark.
TEST_F(FakeQueue, AMarkIsWaitedFor) {
  const auto maker = make_cuda_queue(0), reader = maker->sibling(Urgency::First);
  Buffer<std::uint32_t> memory(maker, 4);
  memory.upload(std::vector<std::uint32_t>{1, 2, 3, 4});
  const auto seen_by_reader = [&] {
    std::vector<std::uint32_t> seen(4);
    reader->download(seen.data(), memory.data(), 16, nullptr);
    return seen;
  };
  maker->clear(memory.data(), 16);
  EXPECT_EQ(seen_by_reader(), (std::vector<std::uint32_t>{1, 2, 3, 4})) << "the stand-ins do nothing before somebody waits for it";
  const auto mark = maker->mark();
  reader->wait_for(*mark);
  EXPECT_EQ(seen_by_reader(), (std::vector<std::uint32_t>{0, 0, 0, 0}));
}

TEST_F(FakeQueue, OutOfMemoryIsSaidAndForgotten) {
  set_up({.devices = {{.memory = 1000000}}});
  const auto queue = make_cuda_queue(0);
  void* const some = queue->allocate(300000);
  try {
    (void)queue->allocate(800000);
    ADD_FAILURE() << "there is no more";
  } catch (const DeviceError& error) {
    EXPECT_STREQ(error.what(),
                 "Stand-in, compute capability 9.0, 0.0 GiB is out of memory: 800000 bytes were asked for, 700000 of 1000000 are free");
  }
  EXPECT_EQ(queue->counters().bytes_allocated, 300000U);
  queue->release(some);
  EXPECT_EQ(queue->counters().bytes_allocated, 0U);
}

TEST_F(FakeQueue, AKernelThatTouchesWhatIsNotItsOwnLosesTheDeviceAndThePositionsStay) {
  const Subject subject = subject_of(lattice(8, 0.35, 98));
  auto queue = make_cuda_queue(0);
  auto smoother = make_device_dmo(queue, subject.task(Metric::MeanRatio));
  std::vector<Vec3> positions = subject.input->mesh.positions;
  smoother->visit(0, subject.visits(), positions, nullptr);
  smoother->store(positions, nullptr);
  const std::vector<Vec3> good = positions;
  const Task nowhere;  // its pointers are null
  queue->launch(Work::Load, Metric::MeanRatio, nowhere, 1);
  EXPECT_THROW(queue->wait(), DeviceError);
  EXPECT_THROW(smoother->visit(0, subject.visits(), positions, nullptr), DeviceError);
  for (Index v = 0; v < good.size(); ++v) ASSERT_TRUE(same(good[v], positions[v]));
  smoother.reset();
  queue.reset();
  EXPECT_THAT(leaks(), ::testing::IsEmpty());
  const auto told = breaches();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_THAT(told[0], ::testing::HasSubstr("out of bounds"));
  set_up({});  // the breach was intended
}

/// A run by the program's accelerator: steps, seeks, and requests of the user between two visits.
TEST_F(FakeQueue, ARunGoesAsOnTheProcessor) {
  Progress progress;
  const auto input = prepare_input(lattice(12, 0.35, 99), {}, Need::Smoothing, progress);
  const Acceleration acceleration = make_accelerator();
  ASSERT_NE(acceleration.accelerator, nullptr);
  const auto run_on = [&](Backend backend) {
    RunParameters parameters;
    parameters.backend = backend;
    return dmoscope::Run(input, parameters, std::make_shared<ThreadPool>(2), std::size_t{1} << 24U, acceleration);
  };
  dmoscope::Run cpu = run_on(Backend::Cpu), cuda = run_on(Backend::Cuda);
  EXPECT_EQ(cuda.backend(), Backend::Cuda);
  const auto both = [&](const char* what, const auto& act) {
    SCOPED_TRACE(what);
    act(cpu);
    act(cuda);
    const auto here = cpu.positions(), there = cuda.positions();
    for (Index v = 0; v < here.size(); ++v) ASSERT_TRUE(same(here[v], there[v])) << v;
    EXPECT_TRUE(same(cpu.statistics().mean, cuda.statistics().mean));
  };
  both("iterate", [&](dmoscope::Run& run) { run.iterate(3, progress); });
  both("a vertex", [&](dmoscope::Run& run) { run.step(StepUnit::Vertex, progress); });
  both("a class", [&](dmoscope::Run& run) { run.step(StepUnit::Class, progress); });
  both("seek", [&](dmoscope::Run& run) { run.seek({1, 7}, progress); });
  both("rest", [&](dmoscope::Run& run) { run.rest(); });
  both("and on", [&](dmoscope::Run& run) { run.iterate(1, progress); });
}

}  // namespace
}  // namespace dmoscope::gpu::fake
