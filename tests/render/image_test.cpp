#include "render/image.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "render/legend.h"
#include "tests/support/picture_difference.h"

namespace dmoscope::render {
namespace {

Image gradient(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.set(x, y,
                {static_cast<std::uint8_t>(x * 5), static_cast<std::uint8_t>(y * 7), 90, static_cast<std::uint8_t>(x % 3 == 0 ? 255 : 40)});
    }
  }
  return image;
}

TEST(Png, RoundTrip) {
  const auto path = std::filesystem::path(::testing::TempDir()) / "dmoscope_round_trip.png";
  const Image image = gradient(37, 21);
  write_png(path, image);
  const Image back = read_png(path);
  EXPECT_EQ(back.width, 37);
  EXPECT_EQ(back.height, 21);
  EXPECT_EQ(back.rgba, image.rgba);
  std::filesystem::remove(path);
}

TEST(Png, Errors) {
  EXPECT_THROW((void)read_png("/no/such/picture.png"), InputError);
  EXPECT_THROW(write_png("/no/such/folder/picture.png", gradient(2, 2)), OutputError);
  const auto path = std::filesystem::path(::testing::TempDir()) / "dmoscope_no_picture.png";
  std::ofstream(path) << "this is no picture";
  EXPECT_THROW((void)read_png(path), InputError);
  std::filesystem::remove(path);
  EXPECT_THROW((void)encode_png(Image()), Error);
}

TEST(Downsample, TransparentPixelsLendNoColour) {
  Image image(2, 2);
  image.set(0, 0, {200, 100, 50, 255});
  const Image small = downsample(image, 2);
  EXPECT_EQ(small.at(0, 0), (Rgba{200, 100, 50, 64}));
}

TEST(Downsample, AveragesLight) {
  Image image(2, 2, {255, 255, 255, 255});
  image.set(0, 0, {0, 0, 0, 255});
  image.set(1, 1, {0, 0, 0, 255});
  EXPECT_EQ(downsample(image, 2).at(0, 0), (Rgba{188, 188, 188, 255})) << "half the light of white is 188 in sRGB";
  EXPECT_THROW((void)downsample(Image(3, 2), 2), UsageError);
}

TEST(Compare, TellsEqualFromDifferent) {
  const Image a = gradient(40, 30);
  const Difference same = compare(a, a);
  EXPECT_TRUE(same.alike());
  EXPECT_EQ(same.largest, 0);
  EXPECT_NEAR(same.ssim, 1.0, 1e-12);
  Image b = a;
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 10; ++x) b.set(x, y, {255, 255, 255, 255});
  }
  const Difference other = compare(a, b);
  EXPECT_NEAR(other.off_share, 100.0 / 1200.0, 1e-12);
  EXPECT_FALSE(other.alike());
  EXPECT_LT(other.ssim, 0.98);
  EXPECT_FALSE(compare(a, gradient(40, 31)).alike(1.0));
}

TEST(BlendOver, CutsAtTheBorders) {
  Image bottom(4, 4, {0, 0, 0, 255});
  blend_over(bottom, Image(3, 3, {255, 255, 255, 128}), -1, 3);
  EXPECT_EQ(bottom.at(0, 3), (Rgba{128, 128, 128, 255}));
  EXPECT_EQ(bottom.at(0, 2), (Rgba{0, 0, 0, 255}));
  EXPECT_EQ(bottom.at(2, 3), (Rgba{0, 0, 0, 255}));
}

TEST(RoundTicks, AreRoundAndInside) {
  EXPECT_EQ(round_ticks(0.0, 1.0, 5), (std::vector<double>{0.0, 0.2, 0.4, 0.2 * 3, 0.8, 1.0}));
  const auto ticks = round_ticks(-0.13, 0.71, 4);
  ASSERT_FALSE(ticks.empty());
  EXPECT_GE(ticks.front(), -0.13);
  EXPECT_LE(ticks.back(), 0.71);
  EXPECT_TRUE(round_ticks(1.0, 1.0, 5).empty());
}

}  // namespace
}  // namespace dmoscope::render
