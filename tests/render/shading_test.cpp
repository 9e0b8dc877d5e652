// Other colourings than quality, elements that do not count, and pictures drawn in slices.
#include <cmath>
#include <limits>
#include <set>

#include "fixture.h"
#include "render/live_picture.h"
#include "tests/support/sanitized.h"

namespace dmoscope::render {
namespace {

constexpr float kNoValue = std::numeric_limits<float>::quiet_NaN();

std::shared_ptr<Shading> shading(Shading::By by, std::vector<float> values, std::vector<Rgb> palette = {}) {
  return std::make_shared<Shading>(Shading{by, std::move(values), false, std::move(palette)});
}

const Rgb kRed{200, 10, 10}, kBlue{10, 10, 200};

TEST_F(WithContext, ValuesOfElementsGoThroughTheMap) {
  load(triangle_and_quadrilateral(), {0.25F, 0.8F});
  scene->set_shading(shading(Shading::By::Elements, {30.0F, 12.5F}));
  Style style = flat_style();
  style.colours.low = 10;
  style.colours.high = 50;
  const Image image = picture(unit_camera(), style);
  EXPECT_TRUE(near_colour(image.at(60, 60), sample(ColourMap::Viridis, 0.5)));
  EXPECT_TRUE(near_colour(image.at(150, 65), sample(ColourMap::Viridis, 0.0625)));
  scene->set_shading(nullptr);
  EXPECT_TRUE(near_colour(picture(unit_camera(), flat_style()).at(60, 60), sample(ColourMap::Viridis, 0.25))) << "quality again";
}

TEST_F(WithContext, CategoriesHaveThePalettesColoursAndInvertedElementsTheirOwn) {
  load(triangle_and_quadrilateral(), {0.25F, 0.8F});
  scene->set_shading(shading(Shading::By::Elements, {1.0F, 0.0F}, {kRed, kBlue}));
  Image image = picture(unit_camera(), flat_style());
  EXPECT_TRUE(near_colour(image.at(60, 60), kBlue, 0));
  EXPECT_TRUE(near_colour(image.at(150, 65), kRed, 0));
  scene->set_shading(shading(Shading::By::Elements, {-1.0F, kNoValue}, {kRed, kBlue}));
  image = picture(unit_camera(), flat_style());
  EXPECT_TRUE(near_colour(image.at(60, 60), flat_style().neutral_colour, 0)) << "of no category";
  int grey = 0;
  for (int x = 115; x < 185; ++x) grey += near_colour(image.at(x, 65), kUndefinedColour) ? 1 : 0;
  EXPECT_GT(grey, 20) << "not defined";
  load(triangle_and_quadrilateral(), {0.25F, 0.8F}, {1, 0});
  scene->set_shading(shading(Shading::By::Elements, {1.0F, 0.0F}, {kRed, kBlue}));
  image = picture(unit_camera(), flat_style());
  int magenta = 0;
  for (int y = 40; y < 100; ++y) magenta += near_colour(image.at(60, y), kInvertedColour) ? 1 : 0;
  EXPECT_GT(magenta, 20);
}

/// Every pixel well inside has the colour of the nearest corner.
TEST_F(WithContext, VerticesColourWhatIsNearestToThem) {
  const Mesh mesh = triangle_and_quadrilateral();
  load(mesh, {0.25F, 0.8F});
  std::vector<Rgb> palette;
  for (int v = 0; v < 7; ++v) palette.push_back({static_cast<std::uint8_t>(30 * v), static_cast<std::uint8_t>(200 - 20 * v), 90});
  scene->set_shading(shading(Shading::By::Vertices, {0, 1, 2, 3, 4, 5, 6}, palette));
  const Image image = picture(unit_camera(), flat_style());
  int looked_at = 0;
  std::set<std::size_t> seen;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Vec2<double> point = unit_camera().to_plane({x + 0.5, y + 0.5}, kViewport);
      const Index element = scene->pick(unit_camera(), kViewport, {x + 0.5, y + 0.5}).element;
      if (element == kNoIndex) continue;
      std::vector<std::pair<double, std::size_t>> corners;
      for (const Index v : mesh.elements.corners(element)) {
        corners.emplace_back(std::hypot(mesh.positions[v].x - point.x, mesh.positions[v].y - point.y), v);
      }
      std::sort(corners.begin(), corners.end());
      if (corners[1].first - corners[0].first < 0.5) continue;
      EXPECT_TRUE(near_colour(image.at(x, y), palette[corners[0].second], 1)) << x << ' ' << y;
      seen.insert(corners[0].second);
      ++looked_at;
    }
  }
  EXPECT_GT(looked_at, 8000);
  EXPECT_EQ(seen.size(), 7U);
}

TEST_F(WithContext, WhatDoesNotCountIsFadedHiddenOrHollow) {
  load(triangle_and_quadrilateral(), {0.25F, 0.8F});
  const Style style = flat_style();
  Selection selection;
  selection.quality = {0.5F, 0.9F};
  const auto look = [&](Selection::Others others) {
    selection.others = others;
    scene->set_selection(selection);
    return picture(unit_camera(), style);
  };
  Image image = look(Selection::Others::Fade);
  EXPECT_TRUE(near_colour(image.at(60, 60), style.faded_colour, 0));
  EXPECT_TRUE(near_colour(image.at(150, 65), sample(ColourMap::Viridis, 0.8)));
  EXPECT_EQ(scene->pick(unit_camera(), kViewport, {60, 60}).element, 0U);
  image = look(Selection::Others::Hide);
  EXPECT_TRUE(near_colour(image.at(60, 60), style.background, 0));
  EXPECT_TRUE(near_colour(image.at(150, 65), sample(ColourMap::Viridis, 0.8)));
  EXPECT_EQ(scene->pick(unit_camera(), kViewport, {60, 60}).element, kNoIndex) << "what is not there is not picked";
  EXPECT_EQ(scene->pick(unit_camera(), kViewport, {21, 111}).vertex, kNoIndex);
  EXPECT_EQ(scene->pick(unit_camera(), kViewport, {150, 65}).element, 1U);
  image = look(Selection::Others::Outline);
  EXPECT_TRUE(near_colour(image.at(60, 60), style.background, 0));
  EXPECT_TRUE(near_colour(image.at(60, 109), style.hollow_colour, 40)) << "its lower edge";
  scene->set_selection({});
  EXPECT_TRUE(near_colour(picture(unit_camera(), style).at(60, 60), sample(ColourMap::Viridis, 0.25)));
}

TEST_F(WithContext, TheRangeHoldsItsEndsAndInvertedElementsFromZeroDown) {
  load(triangle_and_quadrilateral(), {0.25F, -0.8F}, {0, 1});
  const auto shown = [&](float low, float high) {
    Selection selection;
    selection.quality = {low, high};
    selection.others = Selection::Others::Hide;
    scene->set_selection(selection);
    const Image image = picture(unit_camera(), flat_style());
    const Rgb background = flat_style().background;
    const bool triangle = !near_colour(image.at(60, 60), background, 0), quadrilateral = !near_colour(image.at(150, 65), background, 0);
    EXPECT_EQ(triangle, scene->pick(unit_camera(), kViewport, {60, 60}).element == 0U);
    EXPECT_EQ(quadrilateral, scene->pick(unit_camera(), kViewport, {150, 65}).element == 1U);
    return std::pair{triangle, quadrilateral};
  };
  EXPECT_EQ(shown(0.25F, 0.5F), (std::pair{true, false}));
  EXPECT_EQ(shown(0.1F, 0.25F), (std::pair{true, false}));
  EXPECT_EQ(shown(0.26F, 0.5F), (std::pair{false, false}));
  EXPECT_EQ(shown(0.0F, 0.2F), (std::pair{false, true}));
  EXPECT_EQ(shown(-1.0F, 1.0F), (std::pair{true, true}));
}

TEST_F(WithContext, MembersCountAndTheOthersDoNotInSmallAndBigMeshes) {
  const Mesh mesh = wavy_sheet(40, 24);
  const std::vector<float> quality(mesh.elements.size(), 0.5F);
  load(mesh, quality);
  auto members = std::make_shared<std::vector<std::uint8_t>>(quality.size(), std::uint8_t{0});
  for (std::size_t e = 0; e < members->size(); ++e) (*members)[e] = e % 7 < 3 ? 1 : 0;
  Selection selection;
  selection.members = members;
  selection.others = Selection::Others::Hide;
  scene->set_selection(selection);
  const Camera2D camera = Camera2D::fit(scene->bounds(), kViewport, 4);
  const Image image = picture(camera, flat_style());
  scene->set_selection({});
  int wrong = 0, drawn = 0;
  constexpr int kEvery = testing::kSanitized ? 7 : 1;  // a pick takes long there
  for (int y = 0; y < image.height; y += kEvery) {
    for (int x = 0; x < image.width; ++x) {
      const Index element = scene->pick(camera, kViewport, {x + 0.5, y + 0.5}).element;
      const bool wanted = element != kNoIndex && element % 7 < 3;
      wrong += near_colour(image.at(x, y), wanted ? sample(ColourMap::Viridis, 0.5) : flat_style().background) ? 0 : 1;
      drawn += wanted ? 1 : 0;
    }
  }
  EXPECT_GT(drawn, 4000 / kEvery);
  EXPECT_LE(wrong, 60) << "only pixel middles within float rounding of an edge may differ";
  selection.members = std::make_shared<std::vector<std::uint8_t>>(3, std::uint8_t{1});
  EXPECT_THROW(scene->set_selection(selection), UsageError);
  EXPECT_THROW(scene->set_shading(shading(Shading::By::Vertices, {1.0F})), UsageError);
}

TEST_F(WithContext, CoarsePicturesShowTheOneThatCountsAmongThoseThatDoNot) {
  const Mesh mesh = wavy_sheet(300, 180);
  load(mesh, std::vector<float>(mesh.elements.size(), 0.5F));
  auto members = std::make_shared<std::vector<std::uint8_t>>(mesh.elements.size(), std::uint8_t{0});
  (*members)[mesh.elements.size() / 2] = 1;
  Selection selection;
  selection.members = members;
  scene->set_selection(selection);
  const Camera2D camera = Camera2D::fit(scene->bounds(), kViewport, 6);
  const Image image = picture(camera, flat_style(), {}, 0.1);
  int coloured = 0, faded = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      coloured += near_colour(image.at(x, y), sample(ColourMap::Viridis, 0.5)) ? 1 : 0;
      faded += near_colour(image.at(x, y), flat_style().faded_colour) ? 1 : 0;
    }
  }
  EXPECT_GT(coloured, 0);
  EXPECT_LT(coloured, 40);
  EXPECT_GT(faded, 10000);
}

TEST_F(WithContext, SlicesMakeTheSamePicture) {
  const Mesh mesh = wavy_sheet(60, 40);
  std::vector<float> quality(mesh.elements.size());
  for (std::size_t e = 0; e < quality.size(); ++e) quality[e] = static_cast<float>(e % 10) / 9.0F;
  std::vector<std::uint8_t> inverted(quality.size(), 0);
  for (std::size_t e = 11; e < inverted.size(); e += 97) inverted[e] = 1;
  load(mesh, quality, inverted);
  for (const double margin : {4.0, -60.0}) {  // all of the mesh, then a part of it
    const Camera2D camera = Camera2D::fit(scene->bounds(), kViewport, margin);
    Style style = Style::dark();
    style.vertices = true;
    scene->draw_elements(*target, camera, style);
    const Image whole = target->read_pixels();
    SliceProgress progress;
    int slices = 1;
    while (!scene->draw_slice(*target, camera, style, progress, 333)) ++slices;
    EXPECT_GT(slices, 2);
    EXPECT_EQ(target->read_pixels().rgba, whole.rgba);
  }
}

TEST_F(WithContext, ALivePictureComesToRestAtTheFullOneWhateverHappensOnTheWay) {
  const Mesh mesh = wavy_sheet(200, 120);
  std::vector<float> quality(mesh.elements.size(), 0.3F);
  load(mesh, quality);
  LivePicture live;
  LivePicture::Wish wish{200, 120, Camera2D::fit(scene->bounds(), kViewport, 4), Style::dark(), {}, 0.25, true};
  const auto settle = [&] {
    int frames = 0;
    while (!live.complete() && frames < 10'000) {
      live.update(*scene, wish);
      ++frames;
    }
    return frames;
  };
  live.update(*scene, wish);
  EXPECT_FALSE(live.complete()) << "first a coarse one";
  wish.refine = false;
  for (int k = 0; k < 5; ++k) live.update(*scene, wish);
  EXPECT_FALSE(live.complete()) << "not while something moves";
  wish.refine = true;
  live.update(*scene, wish);
  quality.assign(quality.size(), 0.9F);
  scene->update(mesh.positions, quality, {});  // during a picture in slices
  live.update(*scene, wish);
  settle();
  ASSERT_TRUE(live.complete());
  wish.marks.dots.push_back({in_scene(scene->bounds().centre()), 12.0F, {1, 2, 3, 255}, DotShape::Round});
  live.update(*scene, wish);
  EXPECT_TRUE(live.complete()) << "marks ask for no new elements";
  Framebuffer copy(200, 120);
  scene->draw(copy, std::get<Camera2D>(wish.camera), wish.style, wish.marks);
  const Image wanted = copy.read_pixels();
  EXPECT_TRUE(near_colour(wanted.at(100, 60), {1, 2, 3}));
  EXPECT_EQ(live.picture().rgba, wanted.rgba);
  std::get<Camera2D>(wish.camera).pan({7, 3});
  live.update(*scene, wish);
  EXPECT_FALSE(live.complete());
  EXPECT_GT(settle(), 0);
  // Close up all elements are drawn at once.
  std::get<Camera2D>(wish.camera).look_at({20, 20}, 10, kViewport);
  live.update(*scene, wish);
  EXPECT_TRUE(live.complete());
}

TEST_F(WithContext, LabelsGoWhereThereIsRoom) {
  load(triangle_and_quadrilateral(), {0.25F, 0.8F});
  const auto labels = [&](LabelWish wish) { return scene->labels(unit_camera(), kViewport, wish); };
  EXPECT_TRUE(labels({}).empty());
  const auto elements = labels({false, true, 8.0, 15.0, 400});
  ASSERT_EQ(elements.size(), 2U);
  EXPECT_EQ(elements[0].id, 0U);
  EXPECT_EQ(scene->pick(unit_camera(), kViewport, unit_camera().to_pixel(elements[0].point, kViewport)).element, 0U);
  EXPECT_NEAR(elements[1].point.x, 50, 1e-9);
  EXPECT_NEAR(elements[1].point.y, -5, 1e-9);
  const auto vertices = labels({true, false, 8.0, 15.0, 400});
  ASSERT_EQ(vertices.size(), 6U) << "1 and 3 stand too near each other for both";
  EXPECT_EQ(vertices[2].point.x, -40);
  EXPECT_TRUE(labels({true, true, 8.0, 15.0, 8}).empty()) << "nine are more than eight";
  EXPECT_EQ(labels({true, true, 8.0, 15.0, 9}).size(), 8U);
  EXPECT_TRUE(labels({true, true, 100.0, 15.0, 400}).empty()) << "no room for wide figures";
  Camera2D right = unit_camera({60, 0});
  right.units_per_pixel = 0.5;
  for (const Label& label : scene->labels(right, kViewport, {true, true, 8.0, 15.0, 400})) {
    EXPECT_TRUE(label.vertex ? label.id >= 3 : label.id == 1) << "only what is in view";
  }
}

}  // namespace
}  // namespace dmoscope::render
