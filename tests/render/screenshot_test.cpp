#include "render/screenshot.h"

#include "fixture.h"
#include "tests/support/picture_difference.h"

namespace dmoscope::render {
namespace {

class Screenshot : public WithContext {
 protected:
  void SetUp() override {
    WithContext::SetUp();
    if (IsSkipped()) return;
    load(triangle_and_quadrilateral(), {0.25F, 0.8F});
  }
};

TEST_F(Screenshot, HasTheSizeAskedFor) {
  for (const int samples : {1, 2, 3}) {
    Shot shot;
    shot.width = 211;
    shot.height = 97;
    shot.supersample = samples;
    const Image image = render_image(*scene, unit_camera(), Style::dark(), {}, shot).image;
    EXPECT_EQ(image.width, 211);
    EXPECT_EQ(image.height, 97);
    EXPECT_EQ(image.rgba.size(), 4U * 211 * 97);
  }
}

TEST_F(Screenshot, TransparentOutsideOpaqueInside) {
  Shot shot;
  shot.width = 200;
  shot.height = 120;
  shot.supersample = 4;
  shot.transparent = true;
  const Image image = render_image(*scene, unit_camera(), flat_style(), {}, shot).image;
  EXPECT_EQ(image.at(105, 60).a, 0);
  EXPECT_EQ(image.at(2, 2).a, 0);
  EXPECT_TRUE(near_colour(image.at(150, 65), sample(ColourMap::Viridis, 0.8)));
  // Along the triangle's slanting side pixels are covered in part, and have the element's own colour all the same.
  int partly = 0;
  for (int y = 0; y < image.height; ++y) {
    const Rgba c = image.at(45, y);
    if (c.a == 0 || c.a == 255) continue;
    ++partly;
    EXPECT_TRUE(near_colour({c.r, c.g, c.b, 255}, sample(ColourMap::Viridis, 0.25)));
  }
  EXPECT_GT(partly, 0);
}

TEST_F(Screenshot, TilesFitTogether) {
  // The picture is wider than one tile: the same part of the mesh in one tile and in several.
  load(wavy_sheet(40, 20), std::vector<float>(wavy_sheet(40, 20).elements.size(), 0.5F));
  Shot whole;
  whole.width = 1500;
  whole.height = 400;
  whole.supersample = 2;
  Camera2D camera = Camera2D::fit(scene->bounds(), mesh_viewport(whole), 10);
  const Image tiled = render_image(*scene, camera, Style::dark(), {}, whole).image;
  whole.supersample = 1;
  const Image single = render_image(*scene, camera, Style::dark(), {}, whole).image;
  const Difference difference = compare(tiled, single);
  EXPECT_TRUE(difference.alike(0.06)) << difference.off_share;
  // The border of the tiles has no seam: columns there look like their neighbours.
  const auto brightness = [&](int x) {
    double sum = 0;
    for (int y = 0; y < tiled.height; ++y) sum += tiled.at(x, y).g;
    return sum / tiled.height;
  };
  EXPECT_NEAR(brightness(1023), brightness(1024), 25);
}

TEST_F(Screenshot, ADifferentMapIsADifferentPicture) {
  Shot shot;
  shot.width = 200;
  shot.height = 120;
  Style style = Style::dark();
  const Image viridis = render_image(*scene, unit_camera(), style, {}, shot).image;
  EXPECT_TRUE(compare(viridis, render_image(*scene, unit_camera(), style, {}, shot).image).alike());
  style.colours.map = ColourMap::Magma;
  EXPECT_FALSE(compare(viridis, render_image(*scene, unit_camera(), style, {}, shot).image).alike());
}

TEST_F(Screenshot, LegendShowsTheColourBar) {
  Shot shot;
  shot.width = 600;
  shot.height = 300;
  shot.legend.emplace();
  shot.legend->title = "mean ratio";
  shot.legend->subtitle = "two elements";
  shot.legend->inverted = 3;
  shot.legend->undefined = true;
  EXPECT_LT(mesh_viewport(shot).y, 300);
  const Rendered rendered = render_image(*scene, unit_camera(), Style::dark(), {}, shot);
  // Somewhere in the lowest rows the map's two ends lie in one row, low left of high.
  int low_at = -1, high_at = -1;
  for (int y = static_cast<int>(mesh_viewport(shot).y); y < 300 && high_at < 0; ++y) {
    for (int x = 0; x < 600; ++x) {
      if (low_at < 0 && near_colour(rendered.image.at(x, y), sample(ColourMap::Viridis, 0.0), 1)) low_at = x;
      if (near_colour(rendered.image.at(x, y), sample(ColourMap::Viridis, 1.0), 1)) high_at = x;
    }
  }
  EXPECT_GE(low_at, 0);
  EXPECT_GT(high_at, low_at + 80);
}

TEST_F(Screenshot, SizesOutOfRangeAreRefused) {
  Shot shot;
  shot.width = 0;
  EXPECT_THROW((void)render_image(*scene, unit_camera(), Style::dark(), {}, shot), UsageError);
  shot.width = 100000;
  EXPECT_THROW((void)render_image(*scene, unit_camera(), Style::dark(), {}, shot), UsageError);
  shot.width = 10;
  shot.supersample = 9;
  EXPECT_THROW((void)render_image(*scene, unit_camera(), Style::dark(), {}, shot), UsageError);
}

}  // namespace
}  // namespace dmoscope::render
