// A clip plane in words.
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/clipping/clip_to_text.h"

namespace dmoscope {
namespace {

constexpr Vec3 kLow{-1, 0, 10}, kHigh{1, 4, 30};

TEST(ClipWords, AcrossAnAxis) {
  EXPECT_EQ(parse_clip("x", kLow, kHigh), (ClipPlane{.on = true, .normal = {1, 0, 0}, .offset = 0.0}));
  EXPECT_EQ(parse_clip("y:0.25", kLow, kHigh), (ClipPlane{.on = true, .normal = {0, 1, 0}, .offset = 1.0}));
  EXPECT_EQ(parse_clip("-z:1", kLow, kHigh), (ClipPlane{.on = true, .normal = {0, 0, 1}, .offset = 30.0, .flip = true}));
}

TEST(ClipWords, ByNumbers) {
  EXPECT_EQ(parse_clip("1,-2,0.5:-3e2", kLow, kHigh), (ClipPlane{.on = true, .normal = {1, -2, 0.5}, .offset = -300.0}));
}

TEST(ClipWords, WhatMeansNothingIsRefused) {
  for (const char* words : {"", "w", "xy", "x:", "x:2", "x:-0.1", "x:nan", "x:0.5:1", "--x", "1,2:3", "1,2,3", "1,2,3:", "0,0,0:1",
                            "1,2,x:3", "1,2,3:inf", "1e300,1e300,0:1", "1,2,3,4:5"}) {
    EXPECT_THROW(static_cast<void>(parse_clip(words, kLow, kHigh)), UsageError) << words;
  }
  EXPECT_EQ(parse_clip_mode("cut"), ClipPlane::Mode::Cut);
  EXPECT_EQ(parse_clip_mode("crinkle"), ClipPlane::Mode::Crinkle);
  EXPECT_THROW(static_cast<void>(parse_clip_mode("")), UsageError);
}

}  // namespace
}  // namespace dmoscope
