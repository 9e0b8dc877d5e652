#include "render/colour_map.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace dmoscope::render {
namespace {

/// OKLab by its definition (Ottosson 2020), written again by way of CIE XYZ (D65), not as the map's own code has it.
struct Lab {
  double l, a, b;
};
Lab oklab(Rgb c) {
  const auto linear = [](int v) {
    const double x = v / 255.0;
    return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
  };
  const double r = linear(c.r), g = linear(c.g), b = linear(c.b);
  const double x = 0.4123907993 * r + 0.3575843394 * g + 0.1804807884 * b;
  const double y = 0.2126390059 * r + 0.7151686788 * g + 0.0721923154 * b;
  const double z = 0.0193308187 * r + 0.1191947798 * g + 0.9505321522 * b;
  const double l = std::cbrt(0.8189330101 * x + 0.3618667424 * y - 0.1288597137 * z);
  const double m = std::cbrt(0.0329845436 * x + 0.9293118715 * y + 0.0361456387 * z);
  const double s = std::cbrt(0.0482003018 * x + 0.2643662691 * y + 0.6338517070 * z);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s, 1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}
double distance(Lab a, Lab b) { return std::hypot(a.l - b.l, a.a - b.a, a.b - b.b); }

TEST(ColourMap, LightnessRisesEvenly) {
  for (const ColourMapInfo& info : colour_map_table()) {
    const double first = oklab(sample(info.map, 0.0)).l, last = oklab(sample(info.map, 1.0)).l;
    EXPECT_GT(last - first, 0.5) << info.name;
    for (int i = 0; i <= 100; ++i) {
      // 8 bits a channel round lightness, most of all where it is dark.
      EXPECT_NEAR(oklab(sample(info.map, i / 100.0)).l, first + i / 100.0 * (last - first), 0.012) << info.name << " at " << i;
    }
  }
}

TEST(ColourMap, ChangesSmoothly) {
  for (const ColourMapInfo& info : colour_map_table()) {
    for (int i = 1; i <= 256; ++i) {
      EXPECT_LT(distance(oklab(sample(info.map, i / 256.0)), oklab(sample(info.map, (i - 1) / 256.0))), 0.03) << info.name << " at " << i;
    }
  }
}

TEST(ColourMap, OfDifferencesHasItsLightestInTheMiddleAndTwoLikeArms) {
  const auto at = [](double t) { return oklab(sample(ColourMap::OrangeBlue, t)); };
  EXPECT_GT(at(0.5).l, 0.94);
  EXPECT_LT(std::hypot(at(0.5).a, at(0.5).b), 0.02) << "nearly white: nothing has changed";
  for (int i = 0; i < 128; ++i) {
    EXPECT_NEAR(at(i / 256.0).l, at(1.0 - i / 256.0).l, 0.012) << i;
    EXPECT_LT(at(i / 256.0).l, at((i + 1) / 256.0).l + 0.004) << i;
    EXPECT_LT(distance(at(i / 256.0), at((i + 1) / 256.0)), 0.03) << i;
  }
  // Yellow against blue is what red-green blind eyes still tell apart.
  EXPECT_GT(at(0.1).b, 0.05);
  EXPECT_LT(at(0.9).b, -0.05);
  for (const ColourMapInfo& info : colour_map_table()) EXPECT_NE(info.map, ColourMap::OrangeBlue) << "none of quality";
}

TEST(ColourMap, EndsAreThePublishedOnes) {
  EXPECT_EQ(sample(ColourMap::Viridis, 0.0), (Rgb{68, 1, 84}));
  EXPECT_EQ(sample(ColourMap::Viridis, 1.0), (Rgb{253, 231, 37}));
  EXPECT_EQ(sample(ColourMap::Viridis, -3.0), (Rgb{68, 1, 84}));
  EXPECT_EQ(sample(ColourMap::Magma, 7.0), (Rgb{252, 253, 191}));
  // The published middle of viridis; even lightness moves it only a little.
  EXPECT_LT(distance(oklab(sample(ColourMap::Viridis, 0.5)), oklab({33, 145, 140})), 0.06);
}

TEST(ColourMap, InvertedIsInNoMap) {
  for (const ColourMapInfo& info : colour_map_table()) {
    for (int i = 0; i <= 256; ++i)
      EXPECT_GT(distance(oklab(sample(info.map, i / 256.0)), oklab(kInvertedColour)), 0.15) << info.name << " at " << i;
  }
}

TEST(ColourMap, NamesGoBothWays) {
  for (const ColourMapInfo& info : colour_map_table()) {
    EXPECT_EQ(colour_map_from_name(info.name), info.map);
    EXPECT_EQ(name(info.map), info.name);
    EXPECT_FALSE(info.doc.empty());
  }
  EXPECT_THROW((void)colour_map_from_name("rainbow"), UsageError);
}

TEST(ColourScale, ClampsReversesAndSteps) {
  ColourScale scale;
  scale.low = 0.2;
  scale.high = 0.6;
  EXPECT_DOUBLE_EQ(scale.position(0.4), 0.5);
  EXPECT_DOUBLE_EQ(scale.position(-1.0), 0.0);
  EXPECT_DOUBLE_EQ(scale.position(9.0), 1.0);
  scale.reversed = true;
  EXPECT_DOUBLE_EQ(scale.position(0.3), 0.75);
  scale.reversed = false;
  scale.steps = 4;
  EXPECT_DOUBLE_EQ(scale.position(0.21), 0.0);
  EXPECT_DOUBLE_EQ(scale.position(0.31), 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(scale.position(0.6), 1.0);
  EXPECT_EQ(scale.colour(std::numeric_limits<double>::quiet_NaN()), kUndefinedColour);
  scale.high = scale.low;
  EXPECT_TRUE(std::isfinite(scale.position(0.2)));
}

TEST(Oklab, BackAndForth) {
  for (const Rgb c : {Rgb{0, 0, 0}, Rgb{255, 255, 255}, Rgb{12, 200, 77}, Rgb{255, 0, 0}, Rgb{0, 0, 255}})
    EXPECT_EQ(from_oklab(to_oklab(c)), c);
}

}  // namespace
}  // namespace dmoscope::render
