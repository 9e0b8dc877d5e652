// Marks over pictures of volume meshes, and the visible parts of these: rings, outlines, labels.
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "render/volume_scene.h"
#include "tests/render/volume_picture.h"

namespace dmoscope::render {
namespace {

TEST_F(VolumePicture, MarksLieOverTheMesh) {
  Style style = flat_style();
  style.highlight_colour = {1, 2, 3, 255};
  plain.vertices = {0};  // behind all cells
  plain.elements = {6};
  plain.dots.push_back({{1, 0.25, 0.75}, 9.0F, {250, 20, 30, 255}, DotShape::Round});
  plain.dots.push_back({{0, 0.25, 0.75}, 9.0F, {20, 250, 30, 255}, DotShape::Round});  // behind the other
  const Image image = shot(style);
  EXPECT_TRUE(near_colour(at(image, {0, 0, 0}), {1, 2, 3}));
  EXPECT_TRUE(near_colour(at(image, {0, 0.75, 0.5}), {1, 2, 3}, 60));  // an edge of the hidden cell
  EXPECT_TRUE(near_colour(at(image, {1, 0.75, 0.75}), of_quality(0.8)));
  EXPECT_TRUE(near_colour(at(image, {1, 0.25, 0.75}), {250, 20, 30}));
  plain.triad = true;
  const Image with_axes = shot(style);
  // Axes are half as large in a picture half as high as that in which they have their full size.
  EXPECT_GT(with_axes.at(200 - 29 + 12, 120 - 29).g, 100);  // y points right
  EXPECT_GT(with_axes.at(200 - 29, 120 - 29 - 8).b, 150);   // z up
}

TEST_F(VolumePicture, MarksOfWhatWasTakenAwayAreFaint) {
  Style style = flat_style();
  style.highlight_colour = {250, 250, 250, 255};
  plain.worst = 7;  // in the half that is cut away
  const auto most_light = [&] {
    int light = 0;
    const Image image = shot(style);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        light = std::max(light, static_cast<int>(std::min({image.at(x, y).r, image.at(x, y).g, image.at(x, y).b})));
    return light;
  };
  EXPECT_GT(most_light(), 240);
  ClippingView view;
  view.clip = {.on = true, .normal = {1, 0, 0}, .offset = 0.5, .flip = false, .mode = ClipPlane::Mode::Crinkle};
  space->set_view(view);
  EXPECT_FALSE(space->sees_element(7));
  EXPECT_TRUE(space->sees_element(6));
  const int faint = most_light();
  EXPECT_LT(faint, 200);
  EXPECT_GT(faint, 60);
  plain.faint_where_taken_away = false;
  EXPECT_GT(most_light(), 240);
  plain = {};
  plain.triad = false;
  plain.vertices = {26};  // (1, 1, 1)
  EXPECT_LT(most_light(), 200);
  plain.vertices = {25};  // (0.5, 1, 1), of cells on both sides
  EXPECT_GT(most_light(), 240);
}

/// Seen from +x cells of odd numbers hide the others; a ring over a hidden cell would seem to belong to them.
TEST_F(VolumePicture, AWorstCellBehindOthersHasAFaintRing) {
  const auto shown = [&] {
    std::vector<Index> cells;
    for (Index cell = 0; cell < 8; ++cell)
      if (space->shows_element(camera, kViewport, cell)) cells.push_back(cell);
    return cells;
  };
  EXPECT_EQ(shown(), (std::vector<Index>{1, 3, 5, 7}));
  camera.look_from(ViewPreset::MinusX);
  EXPECT_EQ(shown(), (std::vector<Index>{0, 2, 4, 6}));
  camera.look_from(ViewPreset::Isometric);  // from (1, -1, 1)
  EXPECT_EQ(shown(), (std::vector<Index>{0, 1, 3, 4, 5, 6, 7}));
  camera.look_from(ViewPreset::PlusX);
  ClippingView view;
  view.clip = {.on = true, .normal = {1, 0, 0}, .offset = 0.25, .flip = false, .mode = ClipPlane::Mode::Cut};
  space->set_view(view);
  EXPECT_EQ(shown(), (std::vector<Index>{0, 2, 4, 6})) << "their cuts";
  plain.worst = 6;
  const Image clear = shot();
  plain.worst_behind = true;
  EXPECT_NE(shot().rgba, clear.rgba);
}

/// Visible vertices of a cube of 2 x 2 x 2 cells from a corner: those of the three sides that look there.
TEST_F(VolumePicture, NothingHidesTheVerticesOfTheSidesThatAreSeen) {
  camera.look_from(ViewPreset::Isometric);  // from (1, -1, 1)
  const auto expect_unhidden = [&](const char* what, int last_column, bool inner_seen) {
    for (const bool perspective : {false, true}) {
      SCOPED_TRACE(std::string(what) + (perspective ? ", perspective" : ""));
      camera.perspective = perspective;
      camera.fit(space->bounds(), kViewport, 10.0);
      const auto unhidden = space->unhidden(camera, kViewport);
      ASSERT_TRUE(unhidden.has_value());
      std::vector<Index> wanted;
      for (int v = 0; v < 27; ++v) {
        const int i = v % 3, j = v / 3 % 3, k = v / 9;
        if (i <= last_column && ((i == last_column && inner_seen) || j == 0 || k == 2)) wanted.push_back(static_cast<Index>(v));
      }
      EXPECT_EQ(unhidden->vertices, wanted);
    }
  };
  expect_unhidden("all", 2, true);
  const auto unhidden = space->unhidden(camera, kViewport);
  EXPECT_EQ(unhidden->edges.size(), 30U);  // 12 per side, two of them shared by each two sides
  ClippingView view;
  view.clip = {.on = true, .normal = {1, 0, 0}, .offset = 0.5, .flip = false, .mode = ClipPlane::Mode::Crinkle};
  space->set_view(view);
  expect_unhidden("whole cells", 1, true);
  view.clip.mode = ClipPlane::Mode::Cut;
  view.clip.offset = 0.25;
  space->set_view(view);
  expect_unhidden("cut", 0, false);
  EXPECT_TRUE(space->sees_vertex(0));
  EXPECT_FALSE(space->sees_vertex(1));  // a vertex of a cell that is cut through, but beyond the plane
}

TEST_F(VolumePicture, LabelsStandWhereThereIsRoomAndNothingHidesWhatTheyName) {
  LabelWish wish{true, true, 3.0, 5.0, 400};
  const auto ids = [&](bool vertex) {
    std::vector<Index> found;
    for (const Label& label : space->labels(camera, kViewport, wish))
      if (label.vertex == vertex) found.push_back(label.id);
    return found;
  };
  EXPECT_EQ(ids(false), (std::vector<Index>{1, 3, 5, 7}));  // on the side x = 1
  EXPECT_EQ(ids(true), (std::vector<Index>{2, 5, 8, 11, 14, 17, 20, 23, 26}));
  for (const Label& label : space->labels(camera, kViewport, wish)) {
    if (label.id != 3 || label.vertex) continue;  // y from 0.5 to 1, z below
    const auto place = camera.projection(kViewport, space->bounds()).place({1, 0.75, 0.25});
    EXPECT_NEAR(label.point.x, place->x, 1e-9);
    EXPECT_NEAR(label.point.y, place->y, 1e-9);
  }
  // Larger digits: vertices have room beside their neighbours, but those of two digits not beside the cells' ids, 25 pixels away.
  wish.digit_width = 12.0;
  wish.line_height = 34.0;
  EXPECT_EQ(ids(false), (std::vector<Index>{1, 3, 5, 7}));
  EXPECT_EQ(ids(true), (std::vector<Index>{2, 5, 8}));
  wish.digit_width = 3.0;
  wish.line_height = 5.0;
  wish.most = 12;
  EXPECT_TRUE(space->labels(camera, kViewport, wish).empty()) << "13 are too many";
  wish.most = 400;
  wish.digit_width = 60.0;
  EXPECT_TRUE(ids(false).empty());
  EXPECT_TRUE(ids(true).empty());
}
}  // namespace
}  // namespace dmoscope::render
