// Frames of a session, shown one after the other.
#include <chrono>
#include <thread>

#include "core/base/progress.h"
#include "core/input/input_mesh.h"
#include "fixture.h"

namespace dmoscope::render {
namespace {

std::shared_ptr<Frame> frame_of(Mesh mesh, std::uint64_t input_serial, float quality) {
  static std::uint64_t serial = 0;
  Progress progress;
  auto frame = std::make_shared<Frame>();
  frame->serial = ++serial;
  frame->input_serial = input_serial;
  frame->input = prepare_input(std::move(mesh), "sheet.vtk", Need::QualityOnly, progress);
  frame->positions = frame->input->mesh.positions;
  frame->quality.assign(frame->input->mesh.elements.size(), quality);
  frame->inverted.assign(frame->quality.size(), 0);
  return frame;
}

TEST_F(WithContext, ShowsFramesAsTheyChange) {
  const auto first = frame_of(triangle_and_quadrilateral(), 1, 0.3F);
  EXPECT_TRUE(scene->show(first));
  EXPECT_TRUE(near_colour(picture(unit_camera(), flat_style()).at(60, 60), sample(ColourMap::Viridis, 0.3)));
  auto second = std::make_shared<Frame>(*first);
  second->serial += 100;
  second->quality.assign(2, 0.9F);
  EXPECT_TRUE(scene->show(second));
  EXPECT_TRUE(near_colour(picture(unit_camera(), flat_style()).at(60, 60), sample(ColourMap::Viridis, 0.9)));
  EXPECT_TRUE(scene->show(first)) << "an earlier iteration is shown again";
  EXPECT_TRUE(near_colour(picture(unit_camera(), flat_style()).at(60, 60), sample(ColourMap::Viridis, 0.3)));
  EXPECT_TRUE(scene->show(frame_of(wavy_sheet(10, 6), 2, 0.5F)));
  EXPECT_EQ(scene->element_count(), wavy_sheet(10, 6).elements.size());
  EXPECT_TRUE(scene->show(nullptr));
  EXPECT_TRUE(scene->empty());
}

TEST_F(WithContext, FramesAtTheSamePlaceChangeTheirColoursAndOthersTheirPlace) {
  const auto first = frame_of(triangle_and_quadrilateral(), 1, 0.3F);
  auto second = std::make_shared<Frame>(*first);  // another metric, by which the quadrilateral is inverted
  second->serial += 100;
  second->quality = {0.9F, -0.5F};
  second->inverted = {0, 1};
  auto third = std::make_shared<Frame>(*second);  // the mesh moved
  third->serial += 100;
  for (Vec3& position : third->positions) position.x += 40.0;
  EXPECT_TRUE(scene->show(first));
  const Bounds2 before = scene->bounds();
  EXPECT_TRUE(scene->show(second));
  EXPECT_EQ(scene->bounds().low, before.low);
  EXPECT_TRUE(near_colour(picture(unit_camera(), flat_style()).at(60, 60), sample(ColourMap::Viridis, 0.9)));
  const auto inverted = picture(unit_camera(), flat_style());
  EXPECT_FALSE(near_colour(inverted.at(150, 60), sample(ColourMap::Viridis, 0.3)));
  EXPECT_TRUE(scene->show(third));
  EXPECT_EQ(scene->bounds().low, (before.low + Vec2<double>{40.0, 0.0}));
  EXPECT_TRUE(near_colour(picture(unit_camera(), flat_style()).at(100, 60), sample(ColourMap::Viridis, 0.9))) << "where it came to";
  EXPECT_EQ(picture(unit_camera(), flat_style()).at(30, 100), picture(unit_camera(), flat_style()).at(2, 2)) << "nothing is left behind";
  EXPECT_TRUE(scene->show(first));
  EXPECT_EQ(scene->bounds().low, before.low);
}

TEST_F(WithContext, BigMeshesAreMadeReadyInTheBackground) {
  const auto big = frame_of(wavy_sheet(320, 320), 3, 0.4F);
  ASSERT_GT(big->quality.size(), 100'000U);
  bool shown = false;
  for (int i = 0; i < 60'000 && !shown; ++i) {
    shown = scene->show(big, Loading::Background);
    if (!shown) {
      EXPECT_TRUE(scene->empty());
      (void)picture(unit_camera(), flat_style());
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  ASSERT_TRUE(shown);
  EXPECT_EQ(scene->element_count(), big->quality.size());
  const Camera2D camera = Camera2D::fit(scene->bounds(), kViewport);
  EXPECT_TRUE(near_colour(picture(camera, flat_style()).at(100, 60), sample(ColourMap::Viridis, 0.4)));
  // Another mesh is shown while one is being prepared: the latest request wins.
  const auto other = frame_of(wavy_sheet(330, 330), 4, 0.6F);
  (void)scene->show(other, Loading::Background);
  const auto small = frame_of(triangle_and_quadrilateral(), 5, 0.6F);
  EXPECT_TRUE(scene->show(small, Loading::Background));
  EXPECT_EQ(scene->element_count(), 2U);
}

}  // namespace
}  // namespace dmoscope::render
