// Viewports side by side: their contents, their cameras, the split view, and colours of differences.

#include <algorithm>
#include <fstream>
#include <sstream>

#include "render/image.h"
#include "tests/gui/headless_test.h"
#include "tests/support/picture_difference.h"
#include "tests/support/temporary_folder.h"
#include "ui/analysis/element_colours.h"
#include "ui/commands/view_json.h"

namespace dmoscope::app {
namespace {

using Kind = ui::PaneContent::Kind;

class PanesTest : public HeadlessTest {
 protected:
  [[nodiscard]] std::string shows(std::size_t pane) { return state().panes.words(state().panes.panes.at(pane).content); }
  [[nodiscard]] std::vector<std::string> all() {
    std::vector<std::string> words;
    for (std::size_t k = 0; k < state().panes.count(); ++k) words.push_back(shows(k));
    return words;
  }
  [[nodiscard]] ui::Items::Box box(const std::string& name) { return window_->app().items().find(name); }
  /// Drags from the middle of an item by a number of pixels.
  void drag(const std::string& item, float dx, float dy) {
    const auto at = box(item);
    const float x = (at[0] + at[2]) / 2, y = (at[1] + at[3]) / 2;
    good("drag " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(x + dx) + " " + std::to_string(y + dy));
  }
  [[nodiscard]] render::Image cut(const render::Image& of, float left, float top, float right, float bottom) {
    render::Image part(static_cast<int>(right - left), static_cast<int>(bottom - top));
    for (int y = 0; y < part.height; ++y)
      for (int x = 0; x < part.width; ++x) part.set(x, y, of.at(static_cast<int>(left) + x, static_cast<int>(top) + y));
    return part;
  }
};

using Words = std::vector<std::string>;

TEST_F(PanesTest, TheActiveViewportHasButtons) {
  good("generate tetrahedra 200");
  const auto flips = [&](const char* item, const auto& value) {
    const bool before = value();
    good(std::string("click ") + item);
    EXPECT_NE(value(), before) << item;
    good(std::string("click ") + item);
    EXPECT_EQ(value(), before) << item;
  };
  flips("wireframe", [&] { return state().wireframe; });
  flips("worst-marker", [&] { return state().worst_marker; });
  flips("shading", [&] { return state().shading; });
  flips("inside-clip", [&] { return state().inside.clip.on; });
  flips("inside-worst", [&] { return state().inside.worst > 0; });
  EXPECT_EQ(state().picked.kind, ui::Picked::Kind::None) << "no click reached the mesh";
  good("generate annulus");
  EXPECT_FALSE(window_->app().items().boxes().contains("inside-clip")) << "for meshes in space";
  const render::Camera2D fitted = state().camera;
  good("zoom 3");
  good("click fit");
  EXPECT_TRUE(state().camera == fitted);
  good("viewports 2");
  for (const char* pane : {"1", "2"}) {
    good(std::string("focus-pane ") + pane);
    const auto at = box("fit"), viewport = box(std::string("viewport:") + pane);
    EXPECT_GT(at[0], viewport[0]);
    EXPECT_LT(at[2], viewport[2]);
    EXPECT_LT(box(std::string("pane-title:") + pane)[2], at[0]) << "beside the title";
  }
  good("click palette");
  EXPECT_EQ(state().dialog, ui::Dialog::Palette);
}

TEST_F(PanesTest, ALabelWithALineNamesThePickedElement) {
  for (const char* mesh : {"generate annulus 400", "generate tetrahedra 200"}) {
    good(mesh);
    const Index element = session()->frame->worst.front().element;
    good("pick element " + std::to_string(element));
    const auto label = box("pick-label"), viewport = box("viewport");
    EXPECT_GT(label[0], viewport[0]);
    EXPECT_LT(label[2], viewport[2]);
    EXPECT_GT(label[1], viewport[1]);
    EXPECT_LT(label[3], viewport[3]);
    good("pick none");
    EXPECT_FALSE(window_->app().items().boxes().contains("pick-label"));
  }
}

TEST_F(PanesTest, FillThemselvesWithTheRunsAndTheInput) {
  good("generate annulus 400");
  EXPECT_EQ(all(), Words{"active"});
  good("key 2");
  EXPECT_EQ(all(), (Words{"input", "run 1"})) << "before on the left, after on the right";
  EXPECT_EQ(state().panes.focus, 1U) << "commands are about the run";
  good("viewports split");
  EXPECT_EQ(all(), (Words{"input", "run 1"}));
  good("viewports 2");
  good("add-run laplace");
  EXPECT_EQ(all(), (Words{"run 1", "run 2"}));
  EXPECT_EQ(state().panes.focus, 1U);
  good("remove-run 2");
  EXPECT_EQ(all(), (Words{"input", "run 1"}));
  EXPECT_EQ(state().panes.focus, 1U);
  good("focus-pane 1");
  EXPECT_EQ(state().panes.focus, 0U) << "who looks at the input stays there";
  good("generate annulus 500");
  EXPECT_EQ(all(), (Words{"input", "run 1"})) << "of another mesh, too";
  good("key 4");
  EXPECT_EQ(all(), (Words{"run 1", "input", "auto", "auto"}));
  good("add-run dmo:scaled-jacobian");
  EXPECT_EQ(all(), (Words{"run 1", "run 2", "input", "auto"})) << "a new run takes the input's place, which finds another";
  EXPECT_EQ(state().panes.focus, 1U) << "the new run is the active one";
  good("pane 3 run 1 0");
  good("add-run dmo:radius-ratio");
  EXPECT_EQ(all(), (Words{"run 1", "run 2", "run 1 0", "run 3"}));
  good("remove-run 2");
  EXPECT_EQ(all(), (Words{"run 1", "input", "run 1 0", "run 2"})) << "what is left stays where it is, by its new number";
  good("undo");
  EXPECT_EQ(all(), (Words{"run 1", "run 2", "run 1 0", "run 3"}));
  good("viewports 2");
  EXPECT_EQ(all(), (Words{"run 1", "run 3"})) << "the active run is seen in any case";
  good("key Alt+N");
  EXPECT_EQ(session()->active, 0U);
  EXPECT_EQ(state().panes.focus, 0U);
  good("viewports 1");
  EXPECT_EQ(all(), Words{"active"});
  good("viewports 4");
  good("generate annulus 300");
  EXPECT_EQ(all(), (Words{"run 1", "input", "auto", "auto"})) << "of another mesh nothing is left";
}

TEST_F(PanesTest, WhatIsNotThereIsRefused) {
  good("generate annulus 400");
  for (const char* line :
       {"pane 2 input", "pane 1 run 2", "pane 1 mark c", "pane 1", "pane 0 input", "split 1.5", "viewports 3", "focus-pane 2",
        "color-by difference run 9", "color-by difference mark a", "color-by kind input", "color-by difference active"}) {
    EXPECT_TRUE(window_->run(line).has_value()) << line;
    good("dialog none");
  }
  EXPECT_EQ(all(), Words{"active"});
  good("run 3");
  for (const char* line : {"pane 1 run 1 99", "pane 1 run 1 4", "color-by difference run 1 4"}) {
    const auto failure = window_->run(line);
    ASSERT_TRUE(failure.has_value()) << line;
    EXPECT_NE(failure->text.find("it has come to 3"), std::string::npos) << failure->text;
    good("dialog none");
  }
  good("pane 1 run 1 3");
  EXPECT_EQ(all(), Words{"run 1 3"});
}

TEST_F(PanesTest, ATitleMakesItsRunTheActiveOneAndAClickPicksWhereItIs) {
  good("generate annulus 400");
  good("add-run dmo:scaled-jacobian");
  good("run 3");
  good("viewports 2");
  EXPECT_EQ(session()->active, 1U);
  good("click pane-title:1");
  EXPECT_EQ(session()->active, 0U);
  EXPECT_EQ(state().panes.focus, 0U);
  // The place of a vertex in the second viewport, whose run has moved it.
  const auto view = session();
  const auto at = std::ranges::find_if(view->watched, [&](const WatchedFrame& one) { return one.what.run == view->runs[1].id; });
  ASSERT_NE(at, view->watched.end());
  const std::shared_ptr<const Frame> frame = at->frame;
  Index vertex = 0;
  for (Index v = 0; v < frame->vertex_count(); ++v)
    if (length(frame->positions[v] - view->input->mesh.positions[v]) >
        length(frame->positions[vertex] - view->input->mesh.positions[vertex]))
      vertex = v;
  const Vec3 moved = frame->positions[vertex];
  good("camera " + std::to_string(moved.x) + " " + std::to_string(moved.y) + " " + std::to_string(state().camera.units_per_pixel / 20));
  const auto pane = box("viewport:2");
  good("click " + std::to_string((pane[0] + pane[2]) / 2) + " " + std::to_string((pane[1] + pane[3]) / 2));
  EXPECT_EQ(state().picked, (ui::Picked{ui::Picked::Kind::Vertex, vertex}));
}

TEST_F(PanesTest, ADragMovesBothCamerasWhenTheyAreLinkedAndOneWhenNot) {
  good("generate annulus 400");
  good("viewports 2");
  const auto camera = [&](std::size_t pane) { return state().camera_of(pane); };
  const render::Camera2D fitted = camera(0);
  EXPECT_EQ(camera(1), fitted);
  drag("viewport:2", 60, 20);
  EXPECT_NEAR(camera(0).centre.x, fitted.centre.x - 60 * fitted.units_per_pixel, 1e-9);
  EXPECT_EQ(camera(1), camera(0));
  good("link-cameras off");
  const render::Camera2D before = camera(0);
  EXPECT_EQ(camera(1), before);
  drag("viewport:2", 0, 50);
  EXPECT_EQ(camera(0), before);
  EXPECT_NEAR(camera(1).centre.y, before.centre.y + 50 * before.units_per_pixel, 1e-9);
  const render::Camera2D second = camera(1);
  good("focus-pane 2");
  EXPECT_EQ(state().camera, second);
  EXPECT_EQ(camera(0), before);
  good("zoom 2");
  EXPECT_EQ(camera(0), before);
  EXPECT_EQ(camera(1).units_per_pixel, second.units_per_pixel / 2);
  good("link-cameras on");
  EXPECT_EQ(camera(0), camera(1));
}

TEST_F(PanesTest, ColoursOfAllSpanWhatAllShow) {
  good("generate annulus 400");
  good("run 20");
  good("range auto");
  const auto alone = ui::own_range(*session()->frame);
  good("viewports 2");
  const auto view = session();
  ASSERT_EQ(view->watched.size(), 2U);
  const auto input = ui::own_range(*view->watched[0].frame), now = ui::own_range(*view->watched[1].frame);
  ASSERT_TRUE(now && input);
  EXPECT_LT(input->first, now->first);
  const auto range = window_->app().colour_range();
  EXPECT_EQ(range.first, std::min(now->first, input->first));
  EXPECT_EQ(range.second, std::max(now->second, input->second));
  good("viewports 1");
  EXPECT_EQ(window_->app().colour_range(), *alone);
}

TEST_F(PanesTest, ASplitViewHasOneOnTheLeftAndTheOtherOnTheRight) {
  good("generate annulus 400");
  good("run 5");
  good("worst off");
  good("viewports split");
  const auto handle_at = [&](double x) {
    good("split " + std::to_string(x));
    good("move 2 2");
    return window_->picture();
  };
  const render::Image left = handle_at(1.0), right = handle_at(0.0), both = handle_at(0.5);
  const auto a = box("viewport:1"), b = box("viewport:2");
  EXPECT_NEAR(a[2], b[0], 1);
  const float em = 15, top = a[1] + 4 * em, bottom = a[3] - 6 * em, room = 3 * em;  // without titles, bar and handle
  const auto same = [&](const render::Image& whole, float from, float to) {
    return render::compare(cut(both, from, top, to, bottom), cut(whole, from, top, to, bottom));
  };
  EXPECT_EQ(same(left, a[0] + room, a[2] - room).largest, 0);
  EXPECT_EQ(same(right, b[0] + room, b[2] - room).largest, 0);
  EXPECT_GT(same(right, a[0] + room, a[2] - room).largest, 16) << "the two differ";
  drag("split", -100, 0);
  EXPECT_NEAR(state().panes.split, 0.5 - 100 / (b[2] - a[0]), 0.01);
}

TEST_F(PanesTest, APictureHasEveryPaneAndOneBar) {
  const test::TemporaryFolder folder;
  good("generate annulus 400");
  good("run 5");
  const auto shot = [&](const std::string& name) {
    good("screenshot \"" + (folder / name).string() + "\" --size 600x400 --supersample 1");
    return render::read_png(folder / name);
  };
  good("viewports 2");
  const render::Image two = shot("two.png");
  EXPECT_EQ(std::pair(two.width, two.height), std::pair(600, 400));
  good("pane 1 run 1");
  const render::Image same = shot("same.png");
  EXPECT_TRUE(render::compare(cut(same, 310, 30, 600, 340), cut(two, 310, 30, 600, 340)).alike()) << "the right one stays";
  EXPECT_FALSE(render::compare(cut(same, 0, 30, 290, 340), cut(two, 0, 30, 290, 340)).alike());
  EXPECT_TRUE(render::compare(cut(same, 0, 30, 298, 340), cut(same, 302, 30, 600, 340)).alike()) << "the same mesh twice";
}

TEST_F(PanesTest, APictureIsOfTheLayoutOnShowThoughACommandHasChangedIt) {
  good("generate annulus 400");
  good("viewports 4");
  const render::Image four = window_->app().mesh_picture({});
  for (const char* line : {"viewports 2", "viewports 1", "viewports split"}) {
    window_->app().execute(line);  // no frame has been drawn since
    EXPECT_TRUE(render::compare(window_->app().mesh_picture({}), four).alike()) << line;
  }
}

TEST_F(PanesTest, CategoriesAreSeenThoughTheFirstPaneIsEmpty) {
  good("generate annulus 400");
  good("viewports 2");
  good("pane 1 mark a");
  good("color-by valence");
  ASSERT_NE(window_->app().colours(), nullptr);
  EXPECT_EQ(window_->app().colours()->by, ui::ColourBy::Valence);
}

TEST_F(PanesTest, AMarkKeepsItsRunWhateverIsRemoved) {
  good("generate annulus 400");
  good("add-run dmo:scaled-jacobian");
  good("add-run smart-laplace");
  good("run 2");
  good("mark a");
  good("viewports 2");
  good("pane 1 mark a");
  good("pane 2 input");
  const auto picture = [&] { return window_->app().mesh_picture({}); };
  const auto title = [&](const render::Image& whole) { return cut(whole, 30, 0, 120, 30); };
  good("remove-run 1");
  const render::Image second = picture();
  good("add-run dmo:radius-ratio");
  good("select-run 1");
  EXPECT_TRUE(render::compare(title(picture()), title(second)).alike());
  good("remove-run 2");
  const render::Image gone = picture();
  good("undo");
  EXPECT_FALSE(render::compare(title(picture()), title(gone)).alike()) << "without a number: it is no run of the session";
}

TEST_F(PanesTest, ARunMinusItselfIsNothingAndTheReferenceFollows) {
  good("generate annulus 400");
  good("run 3");
  good("color-by difference run 1");
  const auto colours = [&] { return window_->app().colours(); };
  ASSERT_NE(colours(), nullptr);
  for (const float value : colours()->shading->values) ASSERT_EQ(value, 0.0F);
  EXPECT_EQ(colours()->better + colours()->worse, 0U);
  good("color-by difference input");
  ASSERT_NE(colours(), nullptr);
  const auto view = session();
  const QualityContext context = view->input->quality_context();
  std::size_t better = 0;
  double most = 0.0;
  for (Index e = 0; e < view->frame->element_count(); ++e) {
    const double before = element_quality(context, view->input->mesh.positions, Metric::MeanRatio, e);
    const double now = element_quality(context, view->frame->positions, Metric::MeanRatio, e);
    ASSERT_NEAR(static_cast<double>(colours()->shading->values[e]), now - before, 1e-6) << e;
    better += static_cast<float>(now) > static_cast<float>(before) ? 1 : 0;
    most = std::max(most, std::abs(now - before));
  }
  EXPECT_EQ(colours()->better, better);
  EXPECT_NEAR(colours()->range.second, most, 1e-6);
  EXPECT_EQ(colours()->range.first, -colours()->range.second);
  EXPECT_EQ(colours()->title, "Mean ratio: run 1, iteration 3 minus input");
  good("add-run dmo:scaled-jacobian");
  good("color-by difference run 2");
  good("remove-run 2");
  EXPECT_EQ(state().colouring.reference.kind, Kind::Input) << "what is no more is not compared with";
}

/// Two triangles on the corners of a unit square; the second's far corner at `x`.
std::shared_ptr<Frame> two_triangles(double x) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {x, 1, 0}};
  mesh.elements.add(ElementKind::Triangle, std::vector<Index>{0, 1, 2});
  mesh.elements.add(ElementKind::Triangle, std::vector<Index>{1, 3, 2});
  Progress progress;
  auto frame = std::make_shared<Frame>();
  frame->input = prepare_input(std::move(mesh), {}, Need::Smoothing, progress);
  frame->positions = frame->input->mesh.positions;
  frame->shown = Metric::MeanRatio;
  for (Index e = 0; e < 2; ++e)
    frame->quality.push_back(static_cast<float>(element_quality(frame->input->quality_context(), frame->positions, Metric::MeanRatio, e)));
  return frame;
}

TEST(PaneRects, AreAsLargeAsTheMeshAllows) {
  using ui::PaneLayout;
  const ui::Rect area{10, 20, 900, 400};
  const auto rects = [&](PaneLayout layout, double aspect) { return ui::pane_rects(layout, area, 4, aspect, 40); };
  EXPECT_EQ(rects(PaneLayout::One, 1.0).size(), 1U);
  EXPECT_EQ(rects(PaneLayout::One, 1.0)[0].w, 900);
  const auto square = rects(PaneLayout::Four, 2.2);
  ASSERT_EQ(square.size(), 4U);
  EXPECT_EQ(square[0].w, 448);
  EXPECT_EQ(square[3].x, 10 + 448 + 4);
  EXPECT_EQ(square[3].y, 20 + 198 + 4);
  const auto tall = rects(PaneLayout::Four, 0.5);  // 360 high beside each other, 158 in two rows
  EXPECT_EQ(tall[3].y, 20);
  EXPECT_EQ(tall[3].w, 222);
  const auto flat = rects(PaneLayout::Two, 10.0);  // 45 high beside each other, 90 above
  EXPECT_EQ(flat[1].x, 10);
  EXPECT_EQ(flat[1].w, 900);
  EXPECT_EQ(rects(PaneLayout::Split, 1.0)[1].w, 900);
}

TEST(Differences, AreThoseOfTheQualitiesByHand) {
  // Mean ratio of a triangle: 4 sqrt(3) area / sum of squared edges. A right one with legs 1: 2 sqrt(3) / 4; with corners (1, 0), (3, 1),
  // (0, 1): area 3/2, squared edges 5, 9 and 2: 6 sqrt(3) / 16.
  const double root = std::sqrt(3.0);
  const auto before = two_triangles(1.0), after = two_triangles(3.0);
  ui::ColourRequest request{ui::ColourBy::Difference, after, nullptr, render::ColourMap::Viridis, false, nullptr, before};
  const ui::ElementColours colours = ui::colour_elements(request);
  ASSERT_EQ(colours.shading->values.size(), 2U);
  EXPECT_EQ(colours.shading->values[0], 0.0F);
  EXPECT_NEAR(static_cast<double>(colours.shading->values[1]), 6 * root / 16 - 2 * root / 4, 1e-6);
  EXPECT_EQ(colours.better, 0U);
  EXPECT_EQ(colours.worse, 1U);
  EXPECT_NEAR(colours.range.second, 2 * root / 4 - 6 * root / 16, 1e-6);
  const auto scaled = std::make_shared<Frame>(*before);  // a mark made while another metric was on show
  scaled->shown = Metric::ScaledJacobian;
  scaled->quality = {0.123F, 0.456F};
  request.reference = scaled;
  EXPECT_EQ(ui::colour_elements(request).shading->values, colours.shading->values);
}

TEST_F(PanesTest, ARecordedSessionShowsTheSameAgain) {
  const test::TemporaryFolder folder;
  for (const char* line : {"generate annulus 400", "add-run dmo:scaled-jacobian", "run 4", "key 4", "pane 3 run 2 2", "link-cameras off"})
    good(line);
  drag("viewport:2", 40, 10);
  drag("viewport:4", -30, 5);
  good("click pane-title:1");
  good("move 2 2");
  const Words shown = all();
  EXPECT_EQ(shown, (Words{"run 1", "run 2", "run 2 2", "input"}));
  const render::Image wanted = window_->picture();
  const auto path = folder / "session.txt";
  good("save-script \"" + path.string() + "\"");
  std::ifstream file(path);
  Words lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  open();
  for (const std::string& line : lines) good(line);
  good("move 2 2");
  EXPECT_EQ(all(), shown);
  EXPECT_FALSE(state().panes.linked);
  const render::Difference difference = render::compare(window_->picture(), wanted);
  EXPECT_TRUE(difference.alike()) << difference.off_share;
}

TEST_F(PanesTest, ASessionsFileKeepsThem) {
  const test::TemporaryFolder folder;
  for (const char* line : {"generate annulus 400", "add-run dmo:scaled-jacobian", "run 2", "viewports split", "split 0.25",
                           "pane 2 run 1 0", "color-by difference run 2"})
    good(line);
  const Words shown = all();
  const auto path = (folder / "some.dmoscope").string();
  good("save-session \"" + path + "\"");
  open();
  good("open-session \"" + path + "\"");
  EXPECT_EQ(state().panes.layout, ui::PaneLayout::Split);
  EXPECT_EQ(state().panes.split, 0.25);
  EXPECT_EQ(all(), shown);
  EXPECT_TRUE(state().panes.panes[1].chosen);
  EXPECT_EQ(state().panes.words(state().colouring.reference), "run 2");
  ui::ViewState other;
  EXPECT_THROW(ui::apply_view_json(R"({"viewports": {"layout": "3"}})", other, nullptr), UsageError);
  EXPECT_THROW(ui::apply_view_json(R"({"viewports": {"pane1": {"shows": "run 1"}}})", other, nullptr), UsageError);
}

TEST_F(PanesTest, ARunsRowMakesItTheActiveOne) {
  good("generate annulus 400");
  good("add-run dmo:scaled-jacobian");
  good("click run:0");
  EXPECT_EQ(session()->active, 0U);
  good("click run:1");
  EXPECT_EQ(session()->active, 1U);
}

}  // namespace
}  // namespace dmoscope::app
