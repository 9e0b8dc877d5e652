// Choice of a device, and the messages about the others.

#include "gpu/accelerator.h"
#include "gpu/device.h"
#include "tests/gpu/fake/fixture.h"

namespace dmoscope::gpu::fake {
namespace {

using ::testing::HasSubstr;

constexpr std::size_t kGiB = std::size_t{1} << 30U;

class FakeProbing : public OnStandIns {};

TEST_F(FakeProbing, NoDriver) {
  set_up({.devices = {}, .driver = 0});
  const Availability found = availability();
  EXPECT_EQ(found.reason, "no usable CUDA device: no NVIDIA driver is installed");
  EXPECT_EQ(make_accelerator().accelerator, nullptr);
}

TEST_F(FakeProbing, ADriverThatIsTooOld) {
  fail_at(1, kDriverTooOld);
  EXPECT_THAT(availability().reason, HasSubstr("driver version is insufficient"));
}

TEST_F(FakeProbing, NoDevice) {
  set_up({.devices = {}});
  EXPECT_THAT(availability().reason, HasSubstr("no CUDA-capable device is detected"));
}

TEST_F(FakeProbing, OneDevice) {
  const Availability found = availability();
  EXPECT_EQ(found.reason, "");
  EXPECT_EQ(found.best, 0);
  ASSERT_EQ(found.devices.size(), 1U);
  EXPECT_EQ(found.devices[0].name, "Stand-in");
  EXPECT_EQ(found.devices[0].problem, "");
  const Acceleration made = make_accelerator();
  ASSERT_NE(made.accelerator, nullptr) << made.reason;
  EXPECT_EQ(made.accelerator->description(), "Stand-in, compute capability 9.0, 1.0 GiB");
}

TEST_F(FakeProbing, TheOneWithTheMostMemoryIsTaken) {
  for (const std::size_t count : {std::size_t{2}, std::size_t{8}})
    for (std::size_t largest = 0; largest < count; ++largest) {
      Equipment setup{.devices = std::vector<FakeDevice>(count)};
      setup.devices[largest].memory = 2 * kGiB;
      set_up(setup);
      EXPECT_EQ(availability().best, static_cast<int>(largest));
      const Acceleration made = make_accelerator();
      ASSERT_NE(made.accelerator, nullptr) << made.reason;
      EXPECT_EQ(made.accelerator->number(), static_cast<int>(largest));
      EXPECT_THAT(devices_used(), ::testing::ElementsAre(static_cast<int>(largest))) << "the others are left alone";
    }
}

TEST_F(FakeProbing, WhatCannotBeUsedIsNotTakenAndSaysWhy) {
  const std::vector<std::pair<FakeDevice, std::string>> useless{
      {{.name = "Old", .major = 5, .minor = 2, .memory = 4 * kGiB, .too_old = true},
       "the program was not built for its compute capability"},
      {{.name = "Busy", .memory = 4 * kGiB, .refuses = kUnavailable}, "busy or unavailable"},
      {{.name = "Coarse", .memory = 4 * kGiB, .flushes = true}, "its arithmetic differs from the processor's"},
      {{.name = "Full", .memory = 8}, "out of memory"},
  };
  for (const auto& [device, why] : useless) {
    SCOPED_TRACE(device.name);
    set_up({.devices = {device}});
    const Availability alone = availability();
    EXPECT_EQ(alone.best, -1);
    EXPECT_THAT(alone.reason, HasSubstr(device.name + ": "));
    EXPECT_THAT(alone.reason, HasSubstr(why));
    EXPECT_EQ(make_accelerator().accelerator, nullptr);
    for (const bool first : {true, false}) {
      set_up({.devices = first ? std::vector{device, FakeDevice{}} : std::vector{FakeDevice{}, device}});
      const Availability both = availability();
      EXPECT_EQ(both.best, first ? 1 : 0) << both.reason;
      EXPECT_EQ(both.reason, "");
      const bool was_tried = device.memory > FakeDevice{}.memory;
      for (const Device& one : both.devices)
        EXPECT_EQ(one.problem.empty(), one.name == "Stand-in" || !was_tried) << one.name << ": " << one.problem;
    }
  }
}

/// Errors of one device are not reported for another.
TEST_F(FakeProbing, EachIsJudgedByItself) {
  set_up({.devices = std::vector<FakeDevice>(2)});
  (void)availability();
  const std::vector<std::string> all = calls();
  for (std::size_t n = 2; n <= all.size(); ++n) {
    SCOPED_TRACE(std::to_string(n) + " " + all[n - 1]);
    set_up({.devices = std::vector<FakeDevice>(2)});
    fail_at(n, kOperatingSystem);
    const Availability found = availability();
    EXPECT_TRUE(has_failed());
    ASSERT_EQ(found.devices.size(), 2U) << "each device has its number's place";
    EXPECT_EQ(found.reason, "");
    ASSERT_GE(found.best, 0);
    const Device &best = found.devices[static_cast<std::size_t>(found.best)],
                 &other = found.devices[1U - static_cast<unsigned>(found.best)];
    EXPECT_EQ(best.problem, "");
    if (!other.problem.empty()) {
      EXPECT_THAT(other.problem, HasSubstr("OS call failed"));
    }
    EXPECT_TRUE(found.best == 0 || !other.problem.empty()) << "the second is taken where the first fails";
    EXPECT_THAT(leaks(), ::testing::IsEmpty());
  }
}

TEST_F(FakeProbing, ADeviceThatDoesNotEvenTellItsNameIsAReason) {
  fail_at(2, kUnavailable);  // cudaGetDeviceProperties
  EXPECT_THAT(availability().reason, HasSubstr("busy or unavailable"));
}

}  // namespace
}  // namespace dmoscope::gpu::fake
