#pragma once
// Final checks of all tests on stand-ins: no rule was broken, and all was given back.

#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/gpu/fake/runtime.h"

namespace dmoscope::gpu::fake {

class OnStandIns : public ::testing::Test {
 protected:
  void SetUp() override { set_up({}); }
  void TearDown() override {
    EXPECT_THAT(breaches(), ::testing::IsEmpty());
    EXPECT_THAT(leaks(), ::testing::IsEmpty());
  }
};

}  // namespace dmoscope::gpu::fake
