// Display of stepping, and the selection: on plain positions, and in the real window.
#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/engine/engine.h"
#include "core/mesh/element_edges.h"
#include "render/context.h"
#include "render/planar_scene.h"
#include "tests/gui/headless_test.h"
#include "tests/support/meshes.h"
#include "ui/commands/command_words.h"
#include "ui/overlays/moves.h"
#include "ui/overlays/overlays.h"

namespace dmoscope::ui {
namespace {

/// A viewport of 1000 x 1000 pixels on the unit square.
MarkView unit_view(render::Camera2D camera = {{0.5, 0.5}, 1e-3}) { return {render::SceneView(camera, {1000, 1000}), 1.0, {Plane{}}}; }

TEST(Selection, IsASet) {
  Selection selection;
  selection.assign({7, 3, 3, 5});
  EXPECT_EQ(selection.vertices(), (std::vector<Index>{3, 5, 7}));
  const std::uint64_t before = selection.serial();
  selection.add(std::vector<Index>{4, 5});
  EXPECT_GT(selection.serial(), before);
  EXPECT_EQ(selection.vertices(), (std::vector<Index>{3, 4, 5, 7}));
  selection.remove({9, 5, 3});
  EXPECT_EQ(selection.vertices(), (std::vector<Index>{4, 7}));
  EXPECT_TRUE(selection.contains(7));
  EXPECT_FALSE(selection.contains(5));
}

TEST(Selection, RangesOfIdsReadBack) {
  const std::vector<Index> ids{0, 1, 2, 5, 7, 8};
  EXPECT_EQ(id_ranges(ids), "0-2 5 7-8");
  EXPECT_EQ(id_ranges({}), "");
  EXPECT_EQ(parse_id_ranges(split_words(id_ranges(ids)), 9), ids);
  EXPECT_EQ(parse_id_ranges(std::vector<std::string>{"4", "2-4"}, 9), (std::vector<Index>{2, 3, 4}));
  for (const char* wrong : {"9", "3-9", "5-3", "x", "-3", "3-", "1-2-3", ""})
    EXPECT_THROW((void)parse_id_ranges(std::vector<std::string>{wrong}, 9), UsageError) << wrong;
}

TEST(Selection, AStrokeSelectsAddsOrRemoves) {
  Selection selection;
  selection.assign({1, 2, 3});
  Brush brush;
  brush.stroke.assign({3, 4});
  EXPECT_EQ(after_stroke(selection, brush).vertices(), (std::vector<Index>{3, 4}));
  brush.kind = StrokeKind::Add;
  EXPECT_EQ(after_stroke(selection, brush).vertices(), (std::vector<Index>{1, 2, 3, 4}));
  brush.kind = StrokeKind::Remove;
  EXPECT_EQ(after_stroke(selection, brush).vertices(), (std::vector<Index>{1, 2}));
}

TEST(NextClass, IsTheRestOfTheClassUnderWay) {
  const Colouring colouring{{8, 3, 5, 1, 2, 7}, {0, 3, 5, 6}};
  const auto at = [&](std::uint64_t visits) {
    const NextClass next = next_class(colouring, visits);
    return std::pair{next.number, std::vector<Index>(next.vertices.begin(), next.vertices.end())};
  };
  using Expected = std::pair<Index, std::vector<Index>>;
  EXPECT_EQ(at(0), (Expected{1, {8, 3, 5}}));
  EXPECT_EQ(at(1), (Expected{1, {3, 5}}));
  EXPECT_EQ(at(3), (Expected{2, {1, 2}}));
  EXPECT_EQ(at(5), (Expected{3, {7}}));
  EXPECT_EQ(at(6), (Expected{1, {8, 3, 5}})) << "the next iteration's";
  EXPECT_EQ(next_class(colouring, 0).count, 3U);
  EXPECT_EQ(next_class({}, 0).number, 0U);
}

TEST(Arrows, LeadFromWhereVerticesWereLongestFirst) {
  testing::Random random(3);
  std::vector<Vec3> from, to;
  for (int i = 0; i < 500; ++i) {
    const double angle = random(0, 6), length = std::pow(10.0, random(-6, -1));
    from.push_back({random(0.2, 0.8), random(0.2, 0.8), 0});
    to.push_back({from.back().x + length * std::cos(angle), from.back().y + length * std::sin(angle), 0});
  }
  to[7] = from[7];
  const Displacements moved({Plane{}}, from, to);
  std::vector<double> lengths;
  moved.for_each([&](const Displacements::One& one) {
    lengths.push_back(std::hypot(one.way.x, one.way.y));
    return true;
  });
  ASSERT_EQ(lengths.size(), 499U);
  EXPECT_DOUBLE_EQ(moved.longest(), *std::max_element(lengths.begin(), lengths.end()));
  for (std::size_t i = 1; i < lengths.size(); ++i) EXPECT_LE(lengths[i], 2.0001 * lengths[i - 1]) << i;

  render::Marks marks;
  const std::size_t crowded = add_arrows(marks, unit_view(), moved, 1.0, {}).left_out;
  // Pixels are thousandths: arrows of four and more are drawn, each with two lines for its head, all twice.
  const auto long_ones = static_cast<std::size_t>(std::count_if(lengths.begin(), lengths.end(), [](double l) { return l >= 0.004; }));
  EXPECT_GT(long_ones, 50U);
  EXPECT_EQ(marks.lines.size(), 6 * (long_ones - crowded));
  EXPECT_LT(crowded, long_ones / 5);
  render::Marks doubled;
  EXPECT_GT(add_arrows(doubled, unit_view(), moved, 2.0, {}).left_out, 0U);
  EXPECT_GT(doubled.lines.size(), marks.lines.size());
  for (std::size_t i = 0; i < doubled.lines.size() / 2; i += 3) {
    const auto& line = doubled.lines[i];
    const auto v = static_cast<std::size_t>(
        std::find_if(from.begin(), from.end(), [&](Vec3 p) { return p.x == line.from.x && p.y == line.from.y; }) - from.begin());
    ASSERT_LT(v, from.size());
    EXPECT_NEAR(line.to.x, from[v].x + 2 * (to[v].x - from[v].x), 1e-12);
    EXPECT_NEAR(line.to.y, from[v].y + 2 * (to[v].y - from[v].y), 1e-12);
  }
  EXPECT_EQ(arrow_factor(unit_view(), moved, 3.0), 3.0);
  const double longest = arrow_factor(unit_view(), moved, 0.0) * moved.longest();
  EXPECT_NEAR(longest, 0.040, 1e-9);
}

TEST(Arrows, OfWhatStaysOrIsElsewhereAreNone) {
  const std::vector<Vec3> here{{0.5, 0.5, 0}, {9, 9, 0}}, there{{0.5, 0.5, 0}, {9.1, 9, 0}};
  render::Marks marks;
  EXPECT_EQ(add_arrows(marks, unit_view(), Displacements({Plane{}}, here, here), 1.0, {}).left_out, 0U);
  EXPECT_EQ(add_arrows(marks, unit_view(), Displacements({Plane{}}, here, there), 1.0, {}).left_out, 0U);
  EXPECT_EQ(add_arrows(marks, unit_view(), Displacements(), 1.0, {}).left_out, 0U);
  EXPECT_TRUE(marks.lines.empty());
  EXPECT_EQ(arrow_factor(unit_view(), Displacements(), 0.0), 1.0);
}

TEST(Ghost, HasEveryEdgeOfAVertexThatMovedOnce) {
  const auto input = dmoscope::testing::input(dmoscope::testing::lattice(8, 0.0, 1));
  const std::vector<Vec3>& from = input->mesh.positions;
  std::vector<Vec3> to = from;
  const Index vertex = 40;
  to[vertex].x += 0.02;
  render::Unhidden all;
  for (Index e = 0; e < input->mesh.elements.size(); ++e)
    for_edges(input->mesh.elements, e, [&](Index a, Index b) { all.edges.push_back({std::min(a, b), std::max(a, b)}); });
  all.tidy();
  render::Marks marks;
  add_ghost(marks, unit_view(), from, to, all.edges, {});
  ASSERT_EQ(marks.lines.size(), 2 * input->topology.star(vertex).size()) << "as many edges as elements around it, each line cased";
  for (const auto& line : marks.lines) {
    const bool leads_there =
        (line.from.x == from[vertex].x && line.from.y == from[vertex].y) || (line.to.x == from[vertex].x && line.to.y == from[vertex].y);
    EXPECT_TRUE(leads_there);
  }
}

TEST(Dots, AreThereForEveryVertexInViewOrForAnEvenSample) {
  const auto input = dmoscope::testing::input(dmoscope::testing::lattice(200, 0.0, 1));
  std::vector<Index> all(input->mesh.vertex_count());
  for (Index v = 0; v < all.size(); ++v) all[v] = v;
  render::Marks marks;
  MarkView view = unit_view();
  add_dots(marks, view, *input, input->mesh.positions, all, {}, 8.0);
  EXPECT_LE(marks.dots.size(), kMostMarks);
  EXPECT_GE(marks.dots.size(), kMostMarks / 2);
  marks = {};
  view = unit_view({{0.501, 0.501}, 1e-5});  // a hundredth of the view: 2 x 2 vertices
  add_dots(marks, view, *input, input->mesh.positions, all, {}, 8.0);
  ASSERT_EQ(marks.dots.size(), 4U);
  for (const auto& dot : marks.dots) EXPECT_EQ(dot.diameter, 8.0F) << "there is room";
}

class Stepping : public app::HeadlessTest {
 protected:
  void SetUp() override {
    open(1280, 800, Backend::Cpu);
    if (IsSkipped()) return;
    good("generate coast 600");
  }
  void bad(std::string_view line) {
    EXPECT_TRUE(window_->run(line).has_value()) << line;
    state().dialog = Dialog::None;
    state().error_text.clear();
  }
  [[nodiscard]] std::shared_ptr<const Frame> frame() { return window_->app().engine().view()->frame; }
  /// Pixel of a vertex in the window.
  [[nodiscard]] Vec2<double> pixel_of(Index vertex) {
    const auto box = window_->app().items().find("viewport");
    const Vec2<double> p = state().camera.to_pixel({frame()->positions[vertex].x, frame()->positions[vertex].y}, state().viewport);
    return {static_cast<double>(box[0]) + p.x, static_cast<double>(box[1]) + p.y};
  }
  [[nodiscard]] Index some_free_vertex() { return window_->app().engine().view()->runs[0].colouring->order[5]; }
};

TEST_F(Stepping, TheBrushSelectsWhatLiesUnderItAndTheMeshStays) {
  good("brush on");
  good("brush-radius 30");
  const render::Camera2D before = state().camera;
  const Vec2<double> middle = pixel_of(some_free_vertex());
  good(fmt::format("drag {0} {1} {2} {1}", middle.x - 50, middle.y, middle.x + 50));
  EXPECT_TRUE(state().camera == before);
  EXPECT_EQ(state().picked, Picked{}) << "painting picks nothing";
  std::vector<Index> expected;
  for (Index v = 0; v < frame()->vertex_count(); ++v) {
    const Vec2<double> p = pixel_of(v);
    const double along = std::clamp(p.x, middle.x - 50, middle.x + 50);
    const double away = std::hypot(p.x - along, p.y - middle.y);
    if (away <= 29.0) expected.push_back(v);  // the brush dabs every half radius
    if (away > 31.0) {
      EXPECT_FALSE(state().selection.contains(v)) << v;
    }
  }
  EXPECT_GT(expected.size(), 3U);
  std::size_t missed = 0;
  for (const Index v : expected) missed += state().selection.contains(v) ? 0U : 1U;
  EXPECT_LE(missed, expected.size() / 10) << "only in the notches between two dabs";
  good("brush off");
  good(fmt::format("drag {0} {1} {2} {1}", middle.x - 50, middle.y, middle.x + 50));
  EXPECT_FALSE(state().camera == before);
}

TEST_F(Stepping, SelectedVerticesAreSmoothedAndFixed) {
  bad("smooth-selected");
  bad("select vertex 99999");
  bad("select everything");
  const auto order = window_->app().engine().view()->runs[0].colouring->order;
  good("select vertex " + id_ranges(std::vector<Index>{order[3]}));
  good("select add " + id_ranges(std::vector<Index>{order[9]}));
  EXPECT_EQ(state().selection.vertices().size(), 2U);
  const auto before = frame();
  good("smooth-selected");
  EXPECT_NE(frame(), before);
  for (Index v = 0; v < before->vertex_count(); ++v) {
    if (state().selection.contains(v)) continue;
    EXPECT_EQ(frame()->positions[v], before->positions[v]) << v;
  }
  good("fix-selected");
  const auto fixed = window_->app().engine().view()->runs[window_->app().engine().view()->active].parameters.fixed;
  for (const Index v : state().selection.vertices()) EXPECT_NE(std::find(fixed.begin(), fixed.end(), v), fixed.end());
  bad("smooth-selected");  // all of them are fixed now
  good("select none");
  EXPECT_TRUE(state().selection.empty());
  good("select all-in -1e9 -1e9 1e9 1e9");
  EXPECT_EQ(state().selection.vertices().size(), frame()->vertex_count());
  good("generate annulus");
  EXPECT_TRUE(state().selection.empty()) << "another mesh has other vertices";
}

TEST_F(Stepping, AClickSmoothsOneVertexWhereThatIsWanted) {
  const Index vertex = some_free_vertex();
  good(fmt::format("goto vertex {}", vertex));
  good("pick none");
  const Vec2<double> at = pixel_of(vertex);
  const auto before = frame();
  good(fmt::format("click {} {}", at.x, at.y));
  EXPECT_EQ(state().picked.id, vertex);
  EXPECT_EQ(frame()->positions, before->positions);
  good("click-smooths on");
  good(fmt::format("click {} {}", at.x, at.y));
  for (Index v = 0; v < before->vertex_count(); ++v) {
    if (v != vertex) {
      EXPECT_EQ(frame()->positions[v], before->positions[v]) << v;
    }
  }
  EXPECT_NE(frame()->positions[vertex], before->positions[vertex]);
}

TEST_F(Stepping, ThePictureChangesWithWhatIsShown) {
  good("step iteration");
  const auto picture = [&] { return window_->picture().rgba; };
  const auto plain = picture();
  for (const char* line : {"next-class", "arrows input", "ghost input", "arrows previous", "ghost previous"}) {
    const std::string on = std::string(line) + (std::string_view(line) == "next-class" ? " on" : "");
    good(on);
    EXPECT_NE(picture(), plain) << on;
    good(std::string(line == std::string_view("next-class") ? "next-class" : std::string(line).substr(0, std::string(line).find(' '))) +
         " off");
    EXPECT_EQ(picture(), plain) << on;
  }
}

TEST(Overlays, ThePreviousPositionsAreThoseBeforeTheLastCommandThatMovedSomething) {
  Engine engine(1, {}, Backend::Cpu);
  Overlays view;
  ViewState state;
  state.stepping.arrows = Reference::Previous;
  const auto note = [&](const char* line) {
    engine.post(line);
    engine.wait_idle();
    view.update(*engine.view(), false);
    return view.note(state, *engine.view());
  };
  EXPECT_EQ(note("generate coast 600"), "no arrows: nothing has moved yet");
  EXPECT_EQ(note("show min-angle"), "no arrows: nothing has moved yet") << "another metric moves nothing";
  const std::vector<Vec3> input = engine.view()->frame->positions;
  EXPECT_NE(note("step iteration"), "no arrows: nothing has moved yet");
  EXPECT_NE(note("show mean-ratio"), "no arrows: nothing has moved yet");
  const auto context = render::create_headless_context();
  const render::PlanarScene scene;
  const Scenery scenery{state, {}, {}, engine.view()->input.get()};
  const render::Marks marks = view.marks(scenery, *engine.view(), scene, render::Camera2D{{0, 0}, 1e6}, {1000, 1000}, false);
  ASSERT_FALSE(marks.lines.empty());
  const bool from_input = std::any_of(input.begin(), input.end(),
                                      [&](Vec3 p) { return p.x == marks.lines.front().from.x && p.y == marks.lines.front().from.y; });
  EXPECT_TRUE(from_input);
}

}  // namespace
}  // namespace dmoscope::ui
