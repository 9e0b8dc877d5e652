// Pictures of volume meshes: places and colours; and the mouse's picks.
#include "render/volume_scene.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "core/input/input_mesh.h"
#include "render/face_painter.h"
#include "render/live_picture.h"
#include "render/screenshot.h"
#include "tests/render/volume_picture.h"
#include "tests/support/picture_difference.h"
#include "tests/support/volume_grids.h"

namespace dmoscope::render {
namespace {

TEST(FaceRecords, OfAPolygonItsOwnEdgesAreSeen) {
  PlaneCuts cuts;
  cuts.points.resize(12);
  cuts.polygons = {{4, 0, 3}, {5, 3, 4}, {6, 7, 5}};
  std::vector<FaceRecord> records;
  records_of(cuts, records);
  ASSERT_EQ(records.size(), 5U);
  EXPECT_EQ(records[0], (FaceRecord{{0, 1, 2, kNoIndex}, 4}));
  EXPECT_EQ(records[1], (FaceRecord{{3, 4, 5, 6}, 5}));
  EXPECT_EQ(records[2], (FaceRecord{{7, 8, 9, kNoIndex - 4}, 6}));
  EXPECT_EQ(records[3], (FaceRecord{{7, 9, 10, kNoIndex - 5}, 6}));
  EXPECT_EQ(records[4], (FaceRecord{{7, 10, 11, kNoIndex - 1}, 6}));
}

TEST_F(VolumePicture, ColoursTellTheirValuesAloneUnlessALampIsAskedFor) {
  Style lamp = flat_style();
  lamp.shading = true;
  EXPECT_TRUE(near_colour(at(shot(lamp), {1, 0.25, 0.25}), by_lamp(of_quality(0.2))));
  // Three sides are seen from a corner; each face has the colour of its own cell, whichever way it looks.
  camera.look_from(ViewPreset::Isometric);
  camera.fit(space->bounds(), kViewport, 10.0);
  const Image image = shot();
  for (const Vec3 point : {Vec3{1, 0.75, 0.75}, Vec3{0.75, 0.75, 1}}) EXPECT_TRUE(near_colour(at(image, point), of_quality(0.8), 1));
  EXPECT_TRUE(near_colour(at(image, {0.75, 0.25, 1}), of_quality(0.6), 1));
}

TEST_F(VolumePicture, OcclusionDarkensCornersAndEdgesALittle) {
  std::ranges::fill(quality, 0.5F);
  show();
  ClippingView inside;
  inside.isolate = {0.0F, 1.0F};
  camera.look_from(ViewPreset::Isometric);
  camera.fit(space->bounds(), kViewport, 10.0);
  // One cell of eight is gone, and leaves a corner.
  quality[7] = 2.0F;
  show();
  space->set_view(inside);
  Style style = flat_style();
  const Rgb plain_colour = of_quality(0.5);
  const Image without = shot(style);
  style.occlusion = true;
  const Image with = shot(style);
  const auto share = [&](const auto& c) { return static_cast<double>(c.g) / plain_colour.g; };
  int darker = 0, lines = 0, mesh_pixels = 0;
  for (int y = 0; y < with.height; ++y)
    for (int x = 0; x < with.width; ++x) {
      const Rgba a = without.at(x, y), b = with.at(x, y);
      if (!near_colour(a, plain_colour, 2)) {
        EXPECT_EQ(a, b) << "the background stays, at " << x << ' ' << y;
        continue;
      }
      ++mesh_pixels;
      darker += b.g < a.g ? 1 : 0;
      lines += share(b) < 1.0 - static_cast<double>(kMostDarkened) - 0.01 ? 1 : 0;
      EXPECT_GE(share(b), (1.0 - static_cast<double>(kMostDarkened)) * (1.0 - static_cast<double>(kEdgeDarkened)) - 0.01);
      EXPECT_LE(b.g, a.g);
      // All channels are scaled alike: the hue stays.
      EXPECT_NEAR(static_cast<double>(b.r) / std::max(1, static_cast<int>(plain_colour.r)), share(b), 0.03);
    }
  EXPECT_GT(darker, mesh_pixels / 50);
  EXPECT_GT(lines, 0) << "sharp edges";
  EXPECT_LT(lines, mesh_pixels / 6) << "elsewhere by a fifth at most, in a picture of 120 pixels";
  EXPECT_LT(darker, mesh_pixels) << "faces keep their colour away from edges";
  EXPECT_LT(share(at(with, {0.52, 0.52, 0.52})), 0.95) << "in the corner";
  EXPECT_GT(share(at(with, {1, 0.25, 0.25})), 0.99) << "in the middle of a face";
  EXPECT_EQ(with.rgba, shot(style).rgba) << "nothing by chance";
}

TEST_F(VolumePicture, OcclusionFitsTogetherInParts) {
  camera.look_from(ViewPreset::Isometric);
  Style style = flat_style();
  style.occlusion = true;
  const Vec2<double> whole{400, 240};
  camera.fit(space->bounds(), whole, 10.0);
  const auto part = [&](double left, double right) {
    target->resize(static_cast<int>(right - left), 240);
    space->draw_part(*target, camera, style, plain, whole, {{left, 0}, {right, 240}});
    return target->read_pixels();
  };
  const Image all = part(0, 400), left = part(0, 190), right = part(190, 400);
  int wrong = 0;
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 400; ++x) {
      const Rgba expected = all.at(x, y), found = x < 190 ? left.at(x, y) : right.at(x - 190, y);
      wrong += std::abs(expected.r - found.r) + std::abs(expected.g - found.g) + std::abs(expected.b - found.b) > 6 ? 1 : 0;
    }
  EXPECT_LT(wrong, 40) << "of 96,000 pixels; rounding moves an edge here and there";
}

TEST_F(VolumePicture, TheNearCellsHideTheFarOnes) {
  const Image image = shot();
  EXPECT_TRUE(near_colour(at(image, {1, 0.25, 0.25}), of_quality(0.2)));
  EXPECT_TRUE(near_colour(at(image, {1, 0.75, 0.25}), of_quality(0.4)));
  EXPECT_TRUE(near_colour(at(image, {1, 0.25, 0.75}), of_quality(0.6)));
  EXPECT_TRUE(near_colour(at(image, {1, 0.75, 0.75}), of_quality(0.8)));
  EXPECT_EQ(image.at(2, 60), (Rgba{0x1b, 0x1e, 0x23, 255}));
}

TEST_F(VolumePicture, AClipPlaneUncoversWhatLiesBehind) {
  for (const auto mode : {ClipPlane::Mode::Crinkle, ClipPlane::Mode::Cut}) {
    ClippingView view;
    view.clip = {.on = true, .normal = {1, 0, 0}, .offset = 0.5, .flip = false, .mode = mode};
    space->set_view(view);
    EXPECT_TRUE(near_colour(at(shot(), {0.5, 0.25, 0.25}), of_quality(0.1)));
    // A plane through the cells: whole ones remain, or their cuts are visible, in the same colour at another depth.
    view.clip.offset = 0.25;
    view.clip.normal = {1, 0, 0};
    space->set_view(view);
    camera.look_from(ViewPreset::PlusX);
    const Image image = shot();
    EXPECT_TRUE(near_colour(at(image, {0.25, 0.75, 0.75}), of_quality(0.7)));
    // The end of the cells is visible from the side.
    camera.look_from(ViewPreset::MinusY);
    const Image side = shot();
    const bool whole = at(side, {0.4, 0, 0.25}).r != 0x1b;
    EXPECT_EQ(whole, mode == ClipPlane::Mode::Crinkle);
    EXPECT_NE(at(side, {0.1, 0, 0.25}).r, 0x1b);
    camera.look_from(ViewPreset::PlusX);
  }
}

TEST_F(VolumePicture, PositionsAndQualitiesAreChangedInPlace) {
  const Image before = shot();
  quality[1] = 0.9F;
  inverted[3] = 1;
  show();
  const Image after = shot();
  EXPECT_TRUE(near_colour(at(after, {1, 0.25, 0.25}), of_quality(0.9)));
  // Hatching is magenta, plain or in a dark stripe.
  const Rgba hatch = at(after, {1, 0.75, 0.25});
  EXPECT_TRUE(hatch.g < 10 && hatch.r > 70 && hatch.b == hatch.r);
  EXPECT_EQ(at(after, {1, 0.75, 0.75}), at(before, {1, 0.75, 0.75}));
  for (Vec3& p : mesh.positions) p.y *= 0.5;
  show();
  EXPECT_EQ(at(shot(), {1, 0.75, 0.25}).r, 0x1b);  // nothing is left there
  EXPECT_TRUE(near_colour(at(shot(), {1, 0.1, 0.25}), of_quality(0.9)));
}

TEST_F(VolumePicture, ShrunkCellsLeaveRoomBetweenThem) {
  ClippingView view;
  view.shrink = 0.5;
  space->set_view(view);
  const Image image = shot();
  EXPECT_EQ(at(image, {1, 0.5, 0.5}).r, 0x1b);
  EXPECT_TRUE(near_colour(at(image, {1, 0.25, 0.25}), of_quality(0.2)));
  EXPECT_EQ(space->faces().faces.size(), 48U);
}

TEST_F(VolumePicture, WhatIsNotChosenFades) {
  Selection selection;
  selection.quality = std::pair{0.5F, 1.0F};
  space->set_selection(selection);
  const Image image = shot();
  EXPECT_TRUE(near_colour(at(image, {1, 0.25, 0.25}), flat_style().faded_colour));
  EXPECT_TRUE(near_colour(at(image, {1, 0.25, 0.75}), of_quality(0.6)));
}

TEST_F(VolumePicture, TheRestOfTheWorstIsAGhost) {
  ClippingView view;
  view.worst = 1;
  view.ghost = true;
  space->set_view(view);
  const Image image = shot();
  // The worst cell is the far one at the bottom; the ghost's faces before it leave its colour nearly as it is.
  EXPECT_TRUE(near_colour(at(image, {0.5, 0.25, 0.25}), of_quality(0.1), 20));
  const Rgba ghost = at(image, {1, 0.75, 0.75});
  EXPECT_GT(ghost.r, 0x1b + 10);
  EXPECT_LT(ghost.r, 0x1b + 60);
  view.ghost = false;
  space->set_view(view);
  EXPECT_EQ(at(shot(), {1, 0.75, 0.75}).r, 0x1b);
}

/// The four edges of a quadrilateral are drawn, not the diagonal of its triangles.
TEST_F(VolumePicture, TheWireframeIsOfFaces) {
  Style style = flat_style();
  style.wireframe = true;
  style.wire_colour = {255, 0, 0, 255};
  const Image image = shot(style);
  EXPECT_TRUE(near_colour(at(image, {1, 0.25, 0.25}), of_quality(0.2)));  // in the middle of the diagonals
  EXPECT_TRUE(near_colour(at(image, {1, 0.15, 0.15}), of_quality(0.2)));
  EXPECT_GT(at(image, {1, 0.5, 0.25}).r, 110);
  EXPECT_GT(at(image, {1, 0.25, 0.5}).r, 110);
}

TEST_F(VolumePicture, TheMouseFindsWhatIsSeen) {
  const auto pixel_of = [&](Vec3 point) {
    const auto place = camera.projection(kViewport, space->bounds()).place(point);
    return Vec2<double>{0.5 * kWidth + place->x, 0.5 * kHeight - place->y};
  };
  const auto pick = [&](Vec3 point, double radius = 8.0) { return space->pick(camera, kViewport, pixel_of(point), radius); };
  for (const bool perspective : {false, true}) {
    camera.perspective = perspective;
    EXPECT_EQ(pick({1, 0.25, 0.25}).element, 1U);
    EXPECT_EQ(pick({1, 0.75, 0.75}).element, 7U);
    EXPECT_EQ(pick({1, 0.25, 0.25}).vertex, kNoIndex);  // no vertex within 8 pixels
    EXPECT_EQ(pick({1, 0.02, 0.03}).vertex, 2U);
    EXPECT_EQ(pick({1, 0.52, 0.51}).vertex, 14U);
    EXPECT_EQ(pick({1, 3, 3}).element, kNoIndex);
    EXPECT_EQ(pick({1, -0.04, 0.0}).element, kNoIndex);
    EXPECT_EQ(pick({1, -0.04, 0.0}).vertex, 2U);  // beside the mesh, the front one
  }
  camera.perspective = false;
  ClippingView view;
  view.clip = {.on = true, .normal = {1, 0, 0}, .offset = 0.3, .flip = false, .mode = ClipPlane::Mode::Cut};
  space->set_view(view);
  EXPECT_EQ(pick({1, 0.25, 0.25}).element, 0U);
  EXPECT_NEAR(space->point_at(camera, kViewport, pixel_of({1, 0.25, 0.25}))->x, 0.3, 1e-12);  // on the cut
  EXPECT_EQ(pick({1, 0.01, 0.01}).vertex, 0U);                                                // vertices beyond the plane are hidden
  view.clip.on = false;
  view.shrink = 0.5;
  space->set_view(view);
  EXPECT_EQ(pick({1, 0.5, 0.5}).element, kNoIndex);
  EXPECT_EQ(pick({1, 0.25, 0.25}).element, 1U);
}

/// Overlapping cuts in one plane: inverted cells are visible, at any place in the order.
TEST_F(VolumePicture, OfCutsInOnePlaceTheInvertedOneIsSeen) {
  for (const bool first : {true, false}) {
    Mesh twice = test::volume_grid(1, test::Fill::Hexahedra);
    twice.positions.insert(twice.positions.end(), twice.positions.begin(), twice.positions.end());
    std::vector<Index> corners(8);
    std::iota(corners.begin(), corners.end(), 8U);
    twice.elements.add(ElementKind::Hexahedron, corners);
    const FaceNeighbours neighbours(twice);
    const std::vector<float> good{0.7F, 0.7F};
    const std::vector<std::uint8_t> bad{static_cast<std::uint8_t>(first ? 1 : 0), static_cast<std::uint8_t>(first ? 0 : 1)};
    space->set_mesh(twice.elements, neighbours);
    space->update({twice.positions, good, bad, 1});
    ClippingView view;
    view.clip = {.on = true, .normal = {1, 0.1, 0}, .offset = 0.4, .flip = false, .mode = ClipPlane::Mode::Cut};
    space->set_view(view);
    const Image image = shot();
    int magenta = 0, other = 0;
    for (int y = 20; y < 100; ++y) {
      for (int x = 60; x < 140; ++x) (image.at(x, y).g < 10 ? magenta : other) += 1;
    }
    EXPECT_GT(magenta, 6000) << first;
    EXPECT_EQ(other, 0) << first;
  }
}

TEST_F(VolumePicture, FitIsOfWhatThereIsAndNotOfItsBox) {
  // A vertex that no cell uses is far away; the cells lie along a diagonal of their box.
  mesh.positions.push_back({50, 50, 50});
  for (std::size_t v = 0; v < 27; ++v) mesh.positions[v] = mesh.positions[v] + 4.0 * mesh.positions[v].z * Vec3{1, 1, 0};
  show();
  camera.look_from(ViewPreset::PlusX);
  const PicturePart room{{20, 30}, {180, 110}};
  space->fit(camera, kViewport, room);
  double low = 1e9, high = -1e9, top = 1e9, bottom = -1e9;
  const Projection projection = camera.projection(kViewport, space->bounds());
  for (std::size_t v = 0; v < 27; ++v) {
    const auto place = projection.place(mesh.positions[v]);
    low = std::min(low, 0.5 * kWidth + place->x);
    high = std::max(high, 0.5 * kWidth + place->x);
    top = std::min(top, 0.5 * kHeight - place->y);
    bottom = std::max(bottom, 0.5 * kHeight - place->y);
  }
  EXPECT_NEAR(low, 20.0, 1e-6);
  EXPECT_NEAR(high, 180.0, 1e-6);
  EXPECT_GE(top, 30.0);
  EXPECT_LE(bottom, 110.0);
}

TEST_F(VolumePicture, TilesMakeTheSamePictureAsOne) {
  inverted[1] = 1;
  show();
  camera.look_from(ViewPreset::Isometric);
  camera.perspective = true;
  space->draw(*target, camera, Style::dark(), {});
  const Image whole = target->read_pixels();
  Image pieced(whole.width, whole.height);
  for (const double left : {0.0, 80.0}) {
    for (const double top : {0.0, 50.0}) {
      const PicturePart part{{left, top}, {left == 0.0 ? 80.0 : kWidth, top == 0.0 ? 50.0 : kHeight}};
      Framebuffer tile(static_cast<int>(part.high.x - part.low.x), static_cast<int>(part.high.y - part.low.y));
      space->draw_part(tile, camera, Style::dark(), Marks{}, kViewport, part);
      const Image piece = tile.read_pixels();
      for (int y = 0; y < piece.height; ++y) {
        for (int x = 0; x < piece.width; ++x) pieced.set(x + static_cast<int>(left), y + static_cast<int>(top), piece.at(x, y));
      }
    }
  }
  EXPECT_TRUE(compare(whole, pieced).alike(0.002)) << compare(whole, pieced).off_share;
}

/// Fewer faces during movement: the same picture, only coarser.
TEST_F(VolumePicture, LittleDetailLooksMuchTheSame) {
  Mesh fine = test::volume_grid(40, test::Fill::Hexahedra);
  const FaceNeighbours neighbours(fine);
  std::vector<float> good(fine.elements.size(), 0.7F);
  space->set_mesh(fine.elements, neighbours);
  space->update({fine.positions, good, {}, 1});
  const Image full = shot(), coarse = shot(flat_style(), 0.2);
  EXPECT_TRUE(near_colour(at(coarse, {1, 0.43, 0.61}), of_quality(0.7)));
  EXPECT_LT(compare(full, coarse).off_share, 0.12);
}

TEST_F(VolumePicture, ALivePictureComesToRestAtTheFullOne) {
  Mesh fine = test::volume_grid(30, test::Fill::Hexahedra);
  const FaceNeighbours neighbours(fine);
  std::vector<float> good(fine.elements.size(), 0.7F);
  good[5] = 0.1F;
  space->set_mesh(fine.elements, neighbours);
  space->update({fine.positions, good, {}, 1});
  ClippingView view;
  view.clip = {.on = true, .normal = {1, 0.2, 0}, .offset = 0.5, .flip = false, .mode = ClipPlane::Mode::Cut};
  view.ghost = true;
  space->set_view(view);
  LivePicture live;
  LivePicture::Wish wish{static_cast<int>(kWidth), static_cast<int>(kHeight), camera, Style::dark(), Marks{}, 0.25, true};
  live.update(*space, wish);
  EXPECT_FALSE(live.complete());
  for (int turn = 0; turn < 100 && !live.complete(); ++turn) live.update(*space, wish);
  ASSERT_TRUE(live.complete());
  plain.triad = true;
  EXPECT_TRUE(compare(live.picture(), shot(Style::dark())).alike(0.0005));
  // After a new camera there is a coarse picture at once, and no full one during movement.
  std::get<OrbitCamera>(wish.camera).turn({5, 3}, kViewport);
  wish.refine = false;
  for (int turn = 0; turn < 5; ++turn) live.update(*space, wish);
  EXPECT_FALSE(live.complete());
  wish.refine = true;
  for (int turn = 0; turn < 100 && !live.complete(); ++turn) live.update(*space, wish);
  camera = std::get<OrbitCamera>(wish.camera);
  EXPECT_TRUE(compare(live.picture(), shot(Style::dark())).alike(0.0005));
}

TEST_F(VolumePicture, APlainLivePictureDarkensCornersWhenItComesToRest) {
  show();
  camera.look_from(ViewPreset::Isometric);
  camera.fit(space->bounds(), kViewport, 10.0);
  plain.triad = true;
  Style style = flat_style();
  const Image light = shot(style);
  style.occlusion = true;
  const Image dark = shot(style);
  ASSERT_NE(light.rgba, dark.rgba);
  LivePicture live;
  LivePicture::Wish wish{static_cast<int>(kWidth), static_cast<int>(kHeight), camera, style, Marks{}, 1.0, false, true};
  live.update(*space, wish);
  EXPECT_TRUE(live.whole()) << "no element is left out";
  EXPECT_FALSE(live.complete());
  EXPECT_TRUE(compare(live.picture(), light).alike(0.0005));
  wish.refine = true;
  wish.plain = false;
  for (int turn = 0; turn < 100 && !live.complete(); ++turn) live.update(*space, wish);
  EXPECT_TRUE(compare(live.picture(), dark).alike(0.0005));
}

TEST_F(VolumePicture, AFrameIsShownAndTheViewStays) {
  Progress progress;
  const auto input = prepare_input(mesh, {}, Need::QualityOnly, progress);
  auto frame = std::make_shared<Frame>();
  frame->serial = 7;
  frame->input = input;
  frame->positions = mesh.positions;
  frame->quality = quality;
  frame->inverted = inverted;
  ClippingView view;
  view.clip = {.on = true, .normal = {1, 0, 0}, .offset = 0.5};
  ASSERT_TRUE(space->show(frame));
  space->set_view(view);
  EXPECT_TRUE(near_colour(at(shot(), {0.5, 0.25, 0.25}), of_quality(0.1)));
  const std::uint64_t revision = space->revision();
  ASSERT_TRUE(space->show(frame));
  EXPECT_EQ(space->revision(), revision);
  auto next = std::make_shared<Frame>(*frame);
  next->serial = 8;
  next->quality[0] = 0.9F;
  frame.reset();
  ASSERT_TRUE(space->show(next));
  EXPECT_TRUE(near_colour(at(shot(), {0.5, 0.25, 0.25}), of_quality(0.9)));
  next.reset();  // the scene keeps the frame that it shows
  view.clip.on = false;
  space->set_view(view);
  EXPECT_TRUE(near_colour(at(shot(), {1, 0.25, 0.25}), of_quality(0.2)));
  ASSERT_TRUE(space->show(nullptr));
  EXPECT_TRUE(space->empty());
  EXPECT_EQ(shot().at(100, 60).r, 0x1b);
}

TEST_F(VolumePicture, WhatDoesNotFitIsRefused) {
  std::vector<float> few(3);
  EXPECT_THROW(space->update({mesh.positions, few, {}, 1}), UsageError);
  EXPECT_THROW(space->update({std::span(mesh.positions).first(5), quality, {}, 1}), UsageError);
  ClippingView view;
  view.shrink = 2.0;
  const std::uint64_t before = space->revision();
  EXPECT_THROW(space->set_view(view), UsageError);
  space->set_view({});
  EXPECT_EQ(space->revision(), before) << "that is what is seen still";
}

}  // namespace
}  // namespace dmoscope::render
