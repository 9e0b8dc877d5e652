// Colours about sliding, and about what holds the minimum: as data, and in the window.
#include <array>
#include <cmath>
#include <set>

#include <gmock/gmock.h>

#include "core/io/mesh_io.h"
#include "tests/gui/headless_test.h"
#include "tests/support/meshes.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/volume_grids.h"
#include "ui/analysis/counting_elements.h"
#include "ui/analysis/run_colours.h"

namespace dmoscope::ui {
namespace {

struct Seen {
  std::shared_ptr<Frame> frame = std::make_shared<Frame>();
  std::shared_ptr<Run> run;
  Seen(Mesh mesh, const RunParameters& parameters, std::uint64_t iterations) {
    frame->input = testing::input(std::move(mesh));
    run = std::make_shared<Run>(frame->input, parameters, std::make_shared<ThreadPool>(1), 0);
    Progress progress;
    run->iterate(iterations, progress);
    frame->positions.assign(run->positions().begin(), run->positions().end());
    frame->quality.assign(frame->element_count(), 0.5F);
    frame->inverted.assign(frame->element_count(), 0);
  }
  [[nodiscard]] ElementColours colours(ColourBy by) const {
    ColourRequest request;
    request.by = by;
    request.frame = frame;
    request.domain = run->domain();
    request.fixed = run->shared_fixed();
    return colour_elements(request);
  }
};

RunParameters sliding() {
  RunParameters parameters;
  parameters.boundary = BoundaryRule::Slide;
  return parameters;
}

TEST(SlidingColours, FreedomIsOfTheLeastFreeVertex) {
  const Seen seen(test::volume_grid(4, test::Fill::Hexahedra), sliding(), 0);
  const ElementColours colours = seen.colours(ColourBy::Freedom);
  ASSERT_EQ(colours.categories.size(), 4U) << "of a cube: corners, along its edges, on its sides, inside; none is all fixed";
  constexpr std::array<std::size_t, 4> kCounts{8, 24, 24, 8};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(colours.categories[k].name, kFreedoms[k + 1]);
    EXPECT_EQ(colours.categories[k].count, kCounts[k]);
  }
  const Seen fixed(test::volume_grid(2, test::Fill::Tetrahedra), {}, 0);
  std::size_t none_moves = 0;
  for (Index e = 0; e < fixed.frame->element_count(); ++e) {
    bool any = false;
    for (const Index v : fixed.frame->input->mesh.elements.corners(e)) any = any || v == 13;  // vertex 13 in the middle is free
    none_moves += any ? 0 : 1;
  }
  EXPECT_EQ(fixed.colours(ColourBy::Freedom).categories[0].count, none_moves);
}

TEST(SlidingColours, DeviationHasItsUnitAndWhatIsInside) {
  Mesh mesh = test::volume_grid(4, test::Fill::Hexahedra, 0.3, 2);
  for (Vec3& p : mesh.positions) p.z += 0.05 * std::sin(5 * p.x);
  RunParameters parameters = sliding();
  parameters.max_deviation = 0.01;
  const Seen seen(std::move(mesh), parameters, 5);
  for (const ColourBy by : {ColourBy::Deviation, ColourBy::Tilt}) {
    const ElementColours colours = seen.colours(by);
    EXPECT_TRUE(colours.has_values);
    ASSERT_EQ(colours.beside.size(), 1U);
    EXPECT_EQ(colours.beside[0].name, "inside");
    EXPECT_EQ(colours.beside[0].count, 8U) << "2 x 2 x 2 of 4 x 4 x 4";
    EXPECT_EQ(colours.range.first, 0.0);
    EXPECT_GT(colours.range.second, 0.0);
  }
  const ElementColours colours = seen.colours(ColourBy::Deviation);
  EXPECT_LE(colours.range.second, 0.01 * seen.frame->input->geometry.size * (1 + 1e-6));
  EXPECT_THAT(colours.title, ::testing::HasSubstr("of the diagonal"));
  const ElementColours none = Seen(test::volume_grid(2, test::Fill::Hexahedra), {}, 1).colours(ColourBy::Deviation);
  EXPECT_FALSE(none.has_values);
  EXPECT_THAT(none.note, ::testing::HasSubstr("nothing slides"));
}

TEST(SlidingColours, TiltIsOfSurfaces) {
  const auto planar = testing::input(testing::lattice(3, 0.1, 1));
  EXPECT_TRUE(why_not_drawn(ColourBy::Tilt, *planar));
  EXPECT_FALSE(why_not_drawn(ColourBy::Deviation, *planar));
  EXPECT_FALSE(why_unknown({ColourBy::Freedom, "some fixed"}, *planar));
  EXPECT_TRUE(why_unknown({ColourBy::Freedom, "free-ish"}, *planar));
}

class SlidingWindow : public app::HeadlessTest {
 protected:
  void show(const Mesh& mesh, const char* name) {
    Progress progress;
    write_mesh(folder_.path() / name, mesh, mesh.positions, progress);
    good("open \"" + (folder_.path() / name).string() + "\"");
  }
  test::TemporaryFolder folder_;
};

TEST_F(SlidingWindow, ColoursFollowTheRun) {
  Mesh mesh = test::volume_grid(5, test::Fill::Hexahedra, 0.3, 2);
  for (Vec3& p : mesh.positions) p.z += 0.05 * std::sin(5 * p.x);
  show(mesh, "wavy.vtk");
  good("boundary slide");
  std::set<std::vector<std::uint8_t>> pictures;
  for (const char* line : {"color-by freedom", "color-by deviation", "step iteration 2", "color-by tilt", "color-by freedom",
                           "isolate freedom \"some on a curve\"", "isolate off", "boundary fixed", "color-by deviation"}) {
    good(line);
    pictures.insert(window_->picture().rgba);
  }
  EXPECT_EQ(pictures.size(), 8U) << "each another one, but for the seventh, which is the fifth again";
  EXPECT_FALSE(window_->app().colours()->has_values) << "nothing slides in the new run";
  good("generate annulus");
  EXPECT_TRUE(window_->run("color-by tilt").has_value()) << "a plane has no faces that could lean";
}

TEST_F(SlidingWindow, WhatHoldsTheMinimumIsSaidAndSwitched) {
  open_explaining(1280, 1000);
  Mesh mesh = testing::lattice(6, 0.0, 1, testing::Cells::Quadrilaterals);
  mesh.positions[3].x -= 0.15;  // along the boundary, almost to the next vertex
  show(mesh, "spoiled.off");
  good("until-converged");
  const auto held = session()->runs[0].held;
  ASSERT_TRUE(held.found && held.now);
  EXPECT_DOUBLE_EQ(held.found->quality, session()->frame->statistics.minimum);
  ASSERT_TRUE(held.found->change) << held.found->sentence();
  EXPECT_EQ(held.found->change->command(), "boundary slide");
  good("click held-by:switch");
  ASSERT_EQ(session()->runs.size(), 2U) << "the run had begun";
  EXPECT_EQ(session()->runs[1].parameters.boundary, BoundaryRule::Slide);
  EXPECT_EQ(session()->runs[0].parameters.boundary, BoundaryRule::Fixed);
}

}  // namespace
}  // namespace dmoscope::ui
