// Grid inspection of a volume in the real window, off screen.
#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/quality/quality.h"
#include "tests/gui/headless_test.h"
#include "ui/analysis/inspection_text.h"
#include "ui/commands/view_commands.h"
#include "ui/overlays/inspection_marks.h"

namespace dmoscope::app {
namespace {

double along(int axis, Vec3 p) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

TEST(GridSlice, LeadsToEachCandidateOfItsSliceAndBack) {
  for (const int axis : {0, 1, 2}) {
    std::set<int> seen;
    for (int number = 0; number < 4; ++number) {
      const ui::GridSlice slice{4, axis, number};
      for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) {
          const int index = slice.index(column, row);
          EXPECT_EQ(slice.place(index), (std::array{column, row}));
          EXPECT_EQ(slice.along(index), number);
          EXPECT_TRUE(seen.insert(index).second);
          EXPECT_FALSE((ui::GridSlice{4, axis, (number + 1) % 4}.place(index)));
        }
    }
    EXPECT_EQ(seen.size(), 64U);
    EXPECT_EQ(*seen.rbegin(), 63);
  }
}

class VolumeInspection : public HeadlessTest {
 protected:
  [[nodiscard]] ui::InspectionState& inspection() { return state().inspection; }
  [[nodiscard]] const ui::Inspection& look() { return window_->app().inspection(); }
  [[nodiscard]] const RunView& run() { return session()->runs[session()->active]; }
  [[nodiscard]] std::vector<std::uint8_t> picture() { return window_->picture().rgba; }
  [[nodiscard]] render::Marks marks() {
    render::Marks marks;
    ui::InspectionLook how;
    how.units_per_pixel = state().orbit.units_per_pixel(state().viewport);
    ui::add_inspection_marks(marks, inspection(), look(), how);
    return marks;
  }
  static std::size_t count(const render::Marks& marks, std::initializer_list<render::DotShape> shapes) {
    return static_cast<std::size_t>(std::ranges::count_if(
        marks.dots, [&](const render::OverlayDot& dot) { return std::find(shapes.begin(), shapes.end(), dot.shape) != shapes.end(); }));
  }
};

TEST_F(VolumeInspection, ShowsWhatAVisitDoes) {
  for (const char* kind : {"tetrahedra", "hexahedra", "solids"})
    for (const char* precision : {"float", "double"}) {
      SCOPED_TRACE(fmt::format("{}, {}", kind, precision));
      good(fmt::format("generate {} 216 3", kind));
      good(fmt::format("precision {}", precision));
      good("inspect on");
      int moved = 0;
      for (std::size_t i = 0; i < 8; ++i) {
        const auto& order = run().colouring->order;
        const Index vertex = order[(i * 7919 + 13) % order.size()];
        good(fmt::format("pick vertex {}", vertex));
        ASSERT_TRUE(look().solid.has_value()) << look().trouble;
        const VolumeTrace shown = *look().solid;
        ASSERT_EQ(shown.vertex, vertex);
        ASSERT_EQ(shown.levels.size(), 3U);
        ASSERT_EQ(shown.levels[0].quality.size(), 512U);
        const auto before = session()->frame;
        good(fmt::format("visit {}", vertex));
        EXPECT_TRUE(same_bits(before->positions[vertex], shown.from));
        EXPECT_TRUE(same_bits(session()->frame->positions[vertex], shown.to)) << shown.sentence();
        EXPECT_EQ(!same_bits(shown.from, shown.to), shown.end == VisitEnd::Moved);
        moved += shown.end == VisitEnd::Moved ? 1 : 0;
      }
      EXPECT_GT(moved, 3);
    }
}

TEST_F(VolumeInspection, EveryLevelShowsAllItsCandidatesAndWhichInvert) {
  using render::DotShape;
  good("generate tetrahedra 216 3");
  good("inspect-next");
  const auto view = session();
  const Index vertex = inspection().vertex;
  std::vector<Vec3> positions = view->frame->positions;
  for (int level = 1; level <= 3; ++level) {
    good(fmt::format("level {}", level));
    const VolumeLevel& shown = look().solid->levels[static_cast<std::size_t>(level - 1)];
    std::size_t inverting = 0;
    for (int index = 0; index < 512; ++index) {
      positions[vertex] = view->frame->positions[vertex] + shown.at(index);
      inverting += std::ranges::any_of(view->input->topology.star(vertex), [&](const Incidence& at) {
        return smallest_jacobian(view->input->quality_context(), positions, at.element) <= 0.0;
      });
    }
    EXPECT_EQ(count(marks(), {DotShape::Round}), 512U - inverting);
    EXPECT_EQ(count(marks(), {DotShape::Cross}), inverting);
    if (level == 1) {
      EXPECT_GT(inverting, 0U);
    }
    EXPECT_EQ(count(marks(), {DotShape::Ring}), shown.best ? 1U : 0U);
    EXPECT_EQ(ui::level_label(inspection(), look()).substr(0, 12), fmt::format("level {} of 3", level));
  }
  good("level all");
  EXPECT_EQ(count(marks(), {DotShape::Round, DotShape::Cross}), 3U * 512U);
  EXPECT_EQ(ui::grid_phrase(look()), "8 × 8 × 8 candidates a level");
  good("grid 5");
  good("level 1");
  EXPECT_EQ(count(marks(), {DotShape::Round, DotShape::Cross}), 125U);
}

TEST_F(VolumeInspection, TheSliceIsThatOfTheChosenCandidateUntilAnotherIsWanted) {
  good("generate hexahedra 216 3");
  good("inspect-worst");
  ASSERT_TRUE(look().solid.has_value());
  const VolumeLevel& level = look().solid->levels[0];
  ASSERT_TRUE(level.best.has_value());
  for (const int axis : {0, 1, 2}) {
    good(fmt::format("grid-slice {}", "xyz"[axis]));
    const ui::GridSlice slice = ui::shown_slice(inspection(), look(), 1);
    EXPECT_TRUE(slice.place(*level.best).has_value());
    EXPECT_EQ(look().field_slice.axis, axis);
    EXPECT_EQ(look().field_slice.offset, along(axis, level.at(*level.best)));
  }
  good("grid-slice 3");
  const std::vector<float> third = look().field->field.quality;
  for (int index = 0; index < 512; ++index) {
    EXPECT_EQ(ui::shown_slice(inspection(), look(), 1).place(index).has_value(), index % 8 == 2) << index;
  }
  good("grid-slice next");
  EXPECT_EQ(inspection().slice, 3);
  EXPECT_EQ(look().field_slice.offset, level.at(3).z);
  EXPECT_NE(look().field->field.quality, third);
  good("grid-slice back");
  EXPECT_EQ(look().field->field.quality, third);
  good("grid-slice best");
  EXPECT_FALSE(inspection().slice.has_value());
  for (const char* wrong : {"grid-slice 0", "grid-slice 9", "grid-slice w"}) EXPECT_TRUE(window_->run(wrong).has_value()) << wrong;
  good("generate coast 500");
  EXPECT_TRUE(window_->run("grid-slice 1").has_value());
}

TEST_F(VolumeInspection, TheKeyLeadsThroughTheLevelsToTheMove) {
  good("generate tetrahedra 216 3");
  const std::vector<std::uint8_t> whole = picture();
  good("key L");
  ASSERT_TRUE(look().solid.has_value());
  const Index vertex = inspection().vertex;
  EXPECT_EQ(vertex, run().colouring->order[0]);
  std::vector<std::vector<std::uint8_t>> pictures{whole, picture()};
  EXPECT_TRUE(pictures[0] != pictures[1]);
  for (int level = 2; level <= 3; ++level) {
    good("key L");
    EXPECT_EQ(inspection().level, level);
    pictures.push_back(picture());
    EXPECT_TRUE(pictures[pictures.size() - 2] != pictures.back()) << level;
  }
  const VolumeTrace shown = *look().solid;
  good("key L");
  EXPECT_TRUE(inspection().applied);
  EXPECT_EQ(run().moment.visits, 1U);
  EXPECT_TRUE(same_bits(session()->frame->positions[vertex], shown.to));
  EXPECT_TRUE(picture() != pictures.back());
  good("level back");
  EXPECT_FALSE(inspection().applied);
  EXPECT_TRUE(same_bits(session()->frame->positions[vertex], shown.from));
  good("inspect off");
  EXPECT_FALSE(look().solid.has_value());
}

TEST_F(VolumeInspection, CandidatesAreWrittenAsATable) {
  good("generate solids 216 3");
  good("inspect-next");
  good("copy-level 2");
  const std::string text(window_->clipboard());
  EXPECT_EQ(text.substr(0, text.find('\n')), "level,index,i,j,k,x,y,z,value,quality,chosen");
  EXPECT_EQ(std::ranges::count(text, '\n'), 513);
  EXPECT_THAT(text, testing::HasSubstr("\n2,79,1,1,7,"));
}

}  // namespace
}  // namespace dmoscope::app
