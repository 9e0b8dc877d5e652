// Grid inspection in the real window, off screen: effects of its commands, and the result of the levels.
#include <filesystem>
#include <fstream>
#include <memory>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/quality/quality.h"
#include "tests/gui/headless_test.h"
#include "ui/analysis/inspection_text.h"
#include "ui/commands/view_commands.h"
#include "ui/overlays/inspection_marks.h"

namespace dmoscope::app {
namespace {

using ui::Picked;

class InspectionView : public HeadlessTest {
 protected:
  [[nodiscard]] ui::InspectionState& inspection() { return state().inspection; }
  [[nodiscard]] const ui::Inspection& look() { return window_->app().inspection(); }
  [[nodiscard]] render::Marks marks() {
    render::Marks marks;
    ui::InspectionLook how;
    how.units_per_pixel = state().camera.units_per_pixel;
    ui::add_inspection_marks(marks, inspection(), look(), how);
    return marks;
  }
  static std::size_t count(const render::Marks& marks, std::initializer_list<render::DotShape> shapes) {
    std::size_t sum = 0;
    for (const render::OverlayDot& dot : marks.dots) sum += std::find(shapes.begin(), shapes.end(), dot.shape) != shapes.end() ? 1U : 0U;
    return sum;
  }
  /// Elements of a vertex, found only by the table of elements.
  [[nodiscard]] std::vector<Index> star_of(Index vertex) {
    std::vector<Index> star;
    const ElementTable& elements = session()->input->mesh.elements;
    for (Index e = 0; e < elements.size(); ++e) {
      const auto corners = elements.corners(e);
      if (std::find(corners.begin(), corners.end(), vertex) != corners.end()) star.push_back(e);
    }
    return star;
  }
};

TEST_F(InspectionView, OpensAtWhatIsPickedAndCloses) {
  good("generate annulus");
  good("pick vertex 1203");
  good("key G");
  ASSERT_TRUE(inspection().open);
  EXPECT_EQ(inspection().vertex, 1203U);
  ASSERT_TRUE(look().trace.has_value());
  EXPECT_EQ(look().trace->vertex, 1203U);
  std::vector<Index> elements;
  for (const ElementChange& change : look().trace->elements) elements.push_back(change.element);
  EXPECT_EQ(elements, star_of(1203));
  good("pick vertex 1100");
  EXPECT_EQ(look().trace->vertex, 1100U);
  good("key G");
  EXPECT_FALSE(inspection().open);
  EXPECT_FALSE(look().trace.has_value());
}

TEST_F(InspectionView, AnElementIsLookedIntoAtItsWorstFreeCorner) {
  good("generate coast 800");
  good("inspect-worst");
  const Index vertex = inspection().vertex;
  ASSERT_NE(vertex, kNoIndex);
  const auto view = session();
  const auto& fixed = view->runs[0].fixed;
  // The worst of all elements with a free corner, lowest quality first.
  Index worst = kNoIndex;
  for (Index e = 0; e < view->frame->element_count(); ++e) {
    const auto corners = view->input->mesh.elements.corners(e);
    const bool movable = std::any_of(corners.begin(), corners.end(), [&](Index corner) { return fixed[corner] == 0; });
    if (movable && (worst == kNoIndex || view->frame->quality[e] < view->frame->quality[worst])) worst = e;
  }
  const auto corners = view->input->mesh.elements.corners(worst);
  EXPECT_NE(std::find(corners.begin(), corners.end(), vertex), corners.end());
  EXPECT_EQ(fixed[vertex], 0);
  const auto quality = [&](Index corner) {
    return vertex_quality(view->input->quality_context(), view->input->topology, view->frame->positions, Metric::MeanRatio, corner);
  };
  for (const Index corner : corners) {
    if (fixed[corner] == 0) {
      EXPECT_LE(quality(vertex), quality(corner));
    }
  }
  good("pick none");
  good("inspect off");
  good("click why:0");
  EXPECT_TRUE(inspection().open);
}

TEST_F(InspectionView, AnElementWithoutFreeCornersIsSaidToBeTheCeiling) {
  good("generate annulus");
  const auto view = session();
  Index element = 0;
  std::string fix = "fix";
  for (const Index corner : view->input->mesh.elements.corners(element)) fix.append(" ").append(std::to_string(corner));
  good(fix);
  good("inspect element 0");
  EXPECT_TRUE(inspection().open);
  EXPECT_EQ(inspection().vertex, kNoIndex);
  EXPECT_NE(inspection().note.find("fixed"), std::string::npos);
}

TEST_F(InspectionView, EveryLevelShowsAllItsCandidates) {
  good("generate coast 800");
  good("inspect-next");
  using render::DotShape;
  for (int level = 1; level <= 3; ++level) {
    good("level " + std::to_string(level));
    EXPECT_EQ(inspection().level, level);
    EXPECT_EQ(count(marks(), {DotShape::Round, DotShape::Cross}), 64U);
    EXPECT_EQ(count(marks(), {DotShape::Ring}), look().trace->levels[static_cast<std::size_t>(level - 1)].best ? 1U : 0U);
  }
  good("level all");
  EXPECT_EQ(count(marks(), {DotShape::Round, DotShape::Cross}), 3U * 64U);
  good("grid 5");
  good("level 1");
  EXPECT_EQ(count(marks(), {DotShape::Round, DotShape::Cross}), 25U);
  EXPECT_TRUE(window_->run("level 4").has_value());
}

TEST_F(InspectionView, CrossesAreTheCandidatesThatInvertAnElement) {
  good("generate coast");
  good("inspect-worst");
  const auto view = session();
  const InputMesh& input = *view->input;
  std::vector<Vec3> positions = view->frame->positions;
  const TracedLevel& level = look().trace->levels[0];
  std::size_t inverting = 0;
  for (int index = 0; index < 64; ++index) {
    positions[inspection().vertex] = view->frame->positions[inspection().vertex] + input.geometry.plane.lift(level.at(index));
    bool inverts = false;
    for (const Index e : star_of(inspection().vertex)) inverts = inverts || smallest_jacobian(input.quality_context(), positions, e) <= 0.0;
    inverting += inverts ? 1 : 0;
  }
  ASSERT_GT(inverting, 0U);
  EXPECT_EQ(count(marks(), {render::DotShape::Cross}), inverting);
}

TEST_F(InspectionView, LStepsThroughTheLevelsAndThroughTheRun) {
  good("generate annulus");
  const std::vector<Index> order = session()->runs[0].colouring->order;
  const auto before = session()->frame->positions;
  for (std::size_t k = 0; k < 3; ++k) {
    for (int level = 1; level <= 3; ++level) {
      good("key L");
      EXPECT_EQ(inspection().vertex, order[k]);
      EXPECT_EQ(inspection().level, level);
      EXPECT_FALSE(inspection().applied);
      EXPECT_EQ(session()->frame->moment.visits, k);
    }
    const Vec3 to = look().trace->to;
    good("key L");
    EXPECT_TRUE(inspection().applied);
    EXPECT_EQ(session()->frame->moment.visits, k + 1);
    EXPECT_EQ(session()->frame->positions[order[k]], to);
    EXPECT_EQ(look().trace->from, before[order[k]]) << "the search that led there stays to be seen";
  }
  good("key Shift+L");  // takes the move back
  EXPECT_FALSE(inspection().applied);
  EXPECT_EQ(session()->frame->moment.visits, 2U);
  // The run is the same as without any inspection.
  good("key L");
  good("step iteration");
  const auto looked_into = session()->frame->positions;
  good("reset");
  good("step iteration");
  EXPECT_EQ(session()->frame->positions, looked_into);
}

TEST_F(InspectionView, OutOfTurnTheVertexIsVisitedAlone) {
  good("generate coast 800");
  good("inspect-worst");
  const Index vertex = inspection().vertex;
  const auto before = session()->frame->positions;
  ASSERT_EQ(look().trace->end, VisitEnd::Moved);
  const Vec3 to = look().trace->to;
  good("apply-move");
  EXPECT_TRUE(inspection().applied);
  EXPECT_EQ(session()->frame->moment.visits, 0U);
  auto after = session()->frame->positions;
  EXPECT_EQ(after[vertex], to);
  after[vertex] = before[vertex];
  EXPECT_EQ(after, before);
  good("level next");  // the same vertex again, from its present place
  EXPECT_EQ(inspection().vertex, vertex);
  EXPECT_EQ(inspection().level, 1);
  EXPECT_EQ(look().trace->from, to);
  good("apply-move");
  good("level back");  // takes that move back, too
  EXPECT_FALSE(inspection().applied);
  EXPECT_EQ(session()->frame->positions[vertex], to);
}

TEST_F(InspectionView, ACandidateIsReadUnderTheMouseInViewAndHeatMap) {
  good("generate coast");
  good("inspect-worst");
  const TracedLevel& level = look().trace->levels[0];
  const auto& view = window_->app().items().find("viewport");
  const auto pixel = state().camera.to_pixel(Vec2<double>{look().origin.x, look().origin.y} + level.at(21), state().viewport);
  good("move " + std::to_string(static_cast<double>(view[0]) + pixel.x) + " " + std::to_string(static_cast<double>(view[1]) + pixel.y));
  ASSERT_TRUE(inspection().hovered.has_value());
  EXPECT_EQ(*inspection().hovered, (ui::CandidateName{1, 21}));
  const auto map = window_->app().items().find("level:2");
  const float side = map[2] - map[0], top = map[3] - side - 4.0F;  // the cells end above a small gap
  good("move " + std::to_string(map[0] + 0.5F * side / 8) + " " + std::to_string(top + 0.5F * side / 8));
  ASSERT_TRUE(inspection().hovered.has_value());
  EXPECT_EQ(*inspection().hovered, (ui::CandidateName{2, 7})) << "the first column, the highest row";
  EXPECT_EQ(count(marks(), {render::DotShape::Ring}), 1U) << "of another level than the one shown: not in the view";
  good("move 3 3");
  EXPECT_FALSE(inspection().hovered.has_value());
}

TEST_F(InspectionView, AnAppliedMoveIsForgottenWhenSomethingElseMoves) {
  good("generate annulus");
  for (int k = 0; k < 4; ++k) good("key L");
  ASSERT_TRUE(inspection().applied);
  good("step iteration");
  EXPECT_FALSE(inspection().applied);
  EXPECT_EQ(look().trace->from, session()->frame->positions[inspection().vertex]);
}

TEST_F(InspectionView, PlayingShowsEveryLevelAndApplies) {
  good("generate annulus");
  good("play-levels");
  EXPECT_TRUE(inspection().applied);
  EXPECT_FALSE(inspection().playing);
  EXPECT_EQ(session()->frame->moment.visits, 1U);
}

TEST_F(InspectionView, TheViewGoesToAStarThatIsTooSmallAndStaysAtOneThatIsNot) {
  good("generate coast");
  const auto far = state().camera;
  good("inspect vertex 3000");
  const auto near = state().camera;
  EXPECT_LT(near.units_per_pixel, far.units_per_pixel / 4);
  const double star = std::max(look().box.high.x - look().box.low.x, look().box.high.y - look().box.low.y) / near.units_per_pixel;
  EXPECT_GT(star, std::min(state().viewport.x, state().viewport.y) / 8);
  good("inspect off");
  good("inspect on");
  EXPECT_TRUE(state().camera == near);
  good("level 3");
  EXPECT_LT(state().camera.units_per_pixel, near.units_per_pixel / 3);
  good("level 1");
  EXPECT_TRUE(state().camera == near) << "back from the close-up";
  good("inspect-zoom off");
  good("level 3");
  EXPECT_TRUE(state().camera == near);
}

TEST_F(InspectionView, ALongRunClosesIt) {
  for (const char* line : {"key U", "make-good", "each until-converged best", "compare with laplace 2"}) {
    good("generate annulus 300");
    good("inspect-next");
    good("step iteration");
    EXPECT_TRUE(inspection().open) << "single steps go on under it";
    good(line);
    EXPECT_FALSE(inspection().open) << line;
  }
}

TEST_F(InspectionView, AnotherMeshClosesIt) {
  good("generate annulus");
  good("inspect-next");
  good("generate quads");
  EXPECT_FALSE(inspection().open);
  EXPECT_FALSE(look().trace.has_value());
}

TEST_F(InspectionView, TheFieldIsThatOfTheMetricAndItsRegionTheStarsKernel) {
  good("generate annulus");
  good("inspect-next");
  ASSERT_TRUE(look().field.has_value());
  const QualityField& field = look().field->field;
  const double here = look().trace->before.quality;
  EXPECT_LE(look().field->lowest, here);
  EXPECT_GE(look().field->highest, here - 1e-9);
  EXPECT_FALSE(look().field->outline.empty());
  for (const auto& line : look().field->lines) {
    EXPECT_GT(line.value, look().field->lowest);
    EXPECT_LT(line.value, look().field->highest);
  }
  EXPECT_LE(std::max(field.columns, field.rows), 96);
  ASSERT_TRUE(look().optimum.has_value());
  EXPECT_GE(look().optimum->quality, look().field->highest - 1e-9) << "no sample is better than the best there is";
  EXPECT_GE(look().optimum->quality, look().trace->after.quality - 1e-9);
}

TEST_F(InspectionView, TheTraceIsCopiedAndWritten) {
  good("generate annulus");
  good("inspect-next");
  good("copy-level 2");
  const std::string text(window_->clipboard());
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 65);
  EXPECT_EQ(text.substr(0, text.find('\n')), "level,index,i,j,u,v,value,quality,chosen");
  EXPECT_NE(text.find("\n2,63,7,7,"), std::string::npos);
  const auto file = std::filesystem::path(testing::TempDir()) / "dmoscope trace.csv";
  good("export-trace \"" + file.string() + "\"");
  std::ifstream in(file);
  const std::string all{std::istreambuf_iterator<char>(in), {}};
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 1 + 3 * 64);
  std::filesystem::remove(file);
}

TEST_F(InspectionView, AStuckVertexIsExplained) {
  good("generate annulus");
  good("inspect vertex 0");  // a vertex on the boundary
  EXPECT_NE(ui::stuck_sentence(look()).find("fixed"), std::string::npos);
  EXPECT_TRUE(look().trace->levels.empty());
  good("key L");
  EXPECT_EQ(inspection().vertex, 0U);
  good("run 30");
  good("inspect-worst");
  const std::string text = ui::stuck_sentence(look());
  if (look().trace->end == VisitEnd::Moved) {
    EXPECT_TRUE(text.empty());
  } else {
    EXPECT_NE(text.find("limits it"), std::string::npos) << text;
  }
}

TEST_F(InspectionView, SmallWindowsAndLargeInterfacesShowIt) {
  for (const char* setting : {"size 800 600", "size 2560 1600"}) {
    good(setting);
    good(std::string("scale ") + (setting[5] == '8' ? "1" : "2"));
    good("generate annulus");
    good("inspect-next");
    const auto& boxes = window_->app().items().boxes();
    for (const char* item : {"level:1", "level:2", "level:3"}) ASSERT_TRUE(boxes.contains(item)) << item;
    const auto &first = boxes.at("level:1"), &third = boxes.at("level:3");
    EXPECT_EQ(first[1], third[1]) << "side by side";
    EXPECT_GT(third[0], first[2]);
    good("click level:2");
    EXPECT_EQ(inspection().level, 2);
  }
}

TEST_F(InspectionView, LevelBackLeavesAloneWhatCameAfterTheMove) {
  good("generate annulus");
  const auto& order = session()->runs[0].colouring->order;
  const Index first = order.front(), far = order[order.size() / 2];
  good("inspect vertex " + std::to_string(far));
  good("apply-move");
  ASSERT_EQ(session()->runs[0].moment.edits, 1U);
  good("visit " + std::to_string(first));
  ASSERT_EQ(session()->runs[0].moment.edits, 2U);
  good("level back");
  EXPECT_EQ(session()->runs[0].moment.edits, 2U) << "the visit that came after it is not the inspector's to undo";
  good("undo");
  good("level all");
  good("level next");
  good("level back");
  EXPECT_LE(session()->runs[0].moment.edits, 1U);
}

TEST_F(InspectionView, InARunOfAnotherMethodItShowsWhatDmoWouldDoAndMakesNoMove) {
  const auto bad = [this](const char* line) {
    const auto failure = window_->run(line);
    return failure ? failure->text : std::string();
  };
  good("generate annulus");
  good("pick vertex 1203");
  good("key G");
  EXPECT_EQ(ui::other_method_sentence(look()), "");
  const Vec3 dmo_would = look().trace->to;
  good("method laplace");
  ASSERT_TRUE(look().trace.has_value());
  EXPECT_THAT(ui::other_method_sentence(look()), ::testing::AllOf(::testing::HasSubstr("laplace"), ::testing::HasSubstr("dmo would do")));
  EXPECT_EQ(look().trace->to, dmo_would);
  EXPECT_THAT(ui::level_label(inspection(), look()), ::testing::StartsWith("dmo · level"));
  const Vec3 before = session()->frame->positions[1203];
  EXPECT_THAT(bad("apply-move"), ::testing::HasSubstr("visit 1203"));
  EXPECT_EQ(session()->frame->positions[1203], before);
  EXPECT_FALSE(inspection().applied);
  // Playing the levels ends after the last one, without a move.
  inspection().level = 3;
  inspection().playing = true;
  EXPECT_THAT(bad("level next"), ::testing::HasSubstr("laplace"));
  EXPECT_FALSE(inspection().playing);
  EXPECT_EQ(session()->frame->positions[1203], before);
  good("method dmo");
  EXPECT_EQ(ui::other_method_sentence(look()), "");
  good("apply-move");
  EXPECT_EQ(session()->frame->positions[1203], dmo_would);
}

}  // namespace
}  // namespace dmoscope::app
