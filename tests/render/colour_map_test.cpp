#include "render/colour_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace dmoscope::render {
namespace {

/// OKLab by its definition (Ottosson 2020), computed independently by way of CIE XYZ (D65).
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

TEST(ColourMap, LightnessChangesEvenly) {
  for (const ColourMapInfo& info : colour_map_table()) {
    const double first = oklab(sample(info.map, 0.0)).l, last = oklab(sample(info.map, 1.0)).l;
    // If the low end is bright, colours keep away from the darkest and the lightest, which backgrounds have.
    EXPECT_GT(low_is_bright(info.map) ? first - last : last - first, low_is_bright(info.map) ? 0.33 : 0.5) << info.name;
    for (int i = 0; i <= 100; ++i) {
      // Rounding to 8 bits a channel changes lightness, most of all in dark colours.
      EXPECT_NEAR(oklab(sample(info.map, i / 100.0)).l, first + i / 100.0 * (last - first), 0.012) << info.name << " at " << i;
    }
  }
}

/// A colour as seen without a kind of cones (Machado, Oliveira and Fernandes 2009, severity 1), on linear light.
using Vision = std::array<std::array<double, 3>, 3>;
constexpr Vision kProtanopia{{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}};
constexpr Vision kDeuteranopia{{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}};
constexpr Vision kTritanopia{{{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}};

Rgb seen_by(const Vision& vision, Rgb c) {
  const auto linear = [](int v) {
    const double x = v / 255.0;
    return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
  };
  const std::array light{linear(c.r), linear(c.g), linear(c.b)};
  std::array<std::uint8_t, 3> bytes{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double v = std::clamp(vision[i][0] * light[0] + vision[i][1] * light[1] + vision[i][2] * light[2], 0.0, 1.0);
    bytes[i] = static_cast<std::uint8_t>(std::lround(255.0 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055)));
  }
  return {bytes[0], bytes[1], bytes[2]};
}

TEST(Beacon, TellsValuesApartForEveryColourVision) {
  constexpr int kSteps = 20;
  for (const Vision* kind : {&kProtanopia, &kDeuteranopia, &kTritanopia}) {
    const Vision& vision = *kind;
    std::array<Lab, kSteps + 1> seen{};
    for (int i = 0; i <= kSteps; ++i)
      seen[static_cast<std::size_t>(i)] = oklab(seen_by(vision, sample(ColourMap::Beacon, 1.0 * i / kSteps)));
    const double slack = &vision == &kTritanopia ? 0.006 : 0.0;  // the lightest orange lies beyond the screen's gamut
    for (std::size_t i = 0; i < kSteps; ++i) EXPECT_GT(seen[i].l + slack, seen[i + 1].l) << "the worse is the brighter, at " << i;
    for (std::size_t i = 0; i <= kSteps; ++i) {
      // A just noticeable difference is about 0.02.
      for (std::size_t j = i + 4; j <= kSteps; ++j) EXPECT_GT(distance(seen[i], seen[j]), 0.04) << i << " and " << j;
      EXPECT_GT(distance(seen[i], oklab(seen_by(vision, kInvertedColour))), 0.12) << "inverted, at " << i;
    }
    EXPECT_GT(distance(seen.front(), seen.back()), 0.3);
  }
}

TEST(Beacon, TheBadIsBrightAndWarmAndTheGoodIsCalm) {
  const Lab bad = oklab(sample(ColourMap::Beacon, 0.0)), good = oklab(sample(ColourMap::Beacon, 1.0));
  EXPECT_GT(bad.l, good.l + 0.33);
  EXPECT_GT(bad.b, 0.12) << "yellow and orange";
  EXPECT_GT(bad.a, 0.0) << "on the red side";
  EXPECT_LT(good.b, -0.1) << "blue";
}

TEST(Beacon, SinksIntoNoBackground) {
  const auto luminance = [](Rgb c) {
    const auto linear = [](int v) {
      const double x = v / 255.0;
      return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b);
  };
  const auto contrast = [&](Rgb a, Rgb b) {
    const double x = luminance(a) + 0.05, y = luminance(b) + 0.05;
    return std::max(x, y) / std::min(x, y);
  };
  constexpr Rgb kDark{0x1b, 0x1e, 0x23}, kLight{0xf4, 0xf5, 0xf7}, kBlack{0, 0, 0}, kWhite{255, 255, 255};
  double worst_of_viridis = 21.0;
  for (int i = 0; i <= 256; ++i) {
    for (const Rgb background : {kDark, kLight, kBlack, kWhite})
      EXPECT_GT(contrast(sample(ColourMap::Beacon, i / 256.0), background), 1.75) << i;
    worst_of_viridis = std::min(worst_of_viridis, contrast(sample(ColourMap::Viridis, i / 256.0), kDark));
  }
  EXPECT_LT(worst_of_viridis, 1.3) << "which is why it is not the default";
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
  // Yellow against blue is the contrast that remains for red-green blindness.
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
