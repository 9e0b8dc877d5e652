// The list of groups, and the treatment of interfaces, in the window.

#include <gmock/gmock.h>

#include "tests/gui/headless_test.h"
#include "ui/analysis/mesh_parts.h"

namespace dmoscope::app {
namespace {

class GroupsInTheWindow : public HeadlessTest {
 protected:
  [[nodiscard]] const RunParameters& parameters() {
    view_ = session();
    return view_->runs.at(view_->active).parameters;
  }
  std::shared_ptr<const SessionView> view_;
};

TEST_F(GroupsInTheWindow, AreFixedAndLookedAtAlone) {
  open(1280, 1400);
  good("generate nested 100");
  good("click group-fix:inner");
  EXPECT_EQ(parameters().fixed.size(), 36U);
  good("click group-isolate:outer");
  ASSERT_TRUE(state().colouring.isolated.has_value());
  EXPECT_EQ(state().colouring.isolated->name, "outer");
  good("click group-isolate:outer");
  EXPECT_FALSE(state().colouring.isolated.has_value());
  good("fix 0");
  good("click group-fix:inner");
  EXPECT_EQ(parameters().fixed, std::vector<Index>{0}) << "a second click gives that group back and nothing else";
}

TEST_F(GroupsInTheWindow, OfAnotherMeshDoNotHideThisOne) {
  good("generate nested 100");
  good("color-by group");
  good("isolate group inner");
  good("generate grid 100");
  EXPECT_FALSE(state().colouring.isolated.has_value());
  EXPECT_EQ(state().colouring.by, ui::ColourBy::Quality) << "there are no groups to colour by";
}

TEST_F(GroupsInTheWindow, ManyLeaveTheParametersInSight) {
  good("open " + std::string(DMOSCOPE_SOURCE_DIR) + "/resources/samples/coast.14");
  ASSERT_EQ(session()->input->mesh.groups.size(), 11U);
  const auto& boxes = window_->app().items().boxes();
  EXPECT_TRUE(boxes.contains("group-fix:land boundary 3"));
  EXPECT_LT(boxes.at("method")[3], 480.0F) << "of a panel that ends at 546";
}

TEST_F(GroupsInTheWindow, InterfacesAreGivenBackThere) {
  open(1280, 1400);
  good("generate nested 100");
  EXPECT_EQ(parameters().interfaces, InterfaceRule::Fixed);
  const Index free = session()->runs[0].free_vertices;
  good("click interfaces");
  good("click interfaces:free");
  EXPECT_EQ(parameters().interfaces, InterfaceRule::Free);
  EXPECT_EQ(session()->runs[0].free_vertices, free + 20);
  good("generate grid 100");
  EXPECT_TRUE(window_->run("click interfaces").has_value()) << "nothing to choose where there are none";
}

TEST(GroupLines, HaveTheColoursOfTheMesh) {
  Progress progress;
  const auto input = generate_input("nested 100", progress);
  const auto lines = ui::group_lines(input->mesh);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].word, "elements:inner");
  ASSERT_TRUE(lines[0].colour && lines[1].colour);
  EXPECT_NE(*lines[0].colour, *lines[1].colour);
  EXPECT_EQ(lines[0].facts.vertices, 36U);
}

}  // namespace
}  // namespace dmoscope::app
