// The effect of a step, in words and for a moment in the picture.
#include "ui/analysis/step_report.h"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include "tests/gui/headless_test.h"
#include "ui/analysis/scene_points.h"
#include "ui/panels/widgets.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

class StepWindow : public app::HeadlessTest {
 protected:
  [[nodiscard]] const StepNews& news() { return state().stepping.news; }
  [[nodiscard]] static float worst_around(const Frame& frame, Index vertex) {
    float worst = INFINITY;
    for (Index e = 0; e < frame.element_count(); ++e)
      for (const Index corner : frame.input->mesh.elements.corners(e))
        if (corner == vertex) worst = std::min(worst, frame.quality[e]);
    return worst;
  }
  [[nodiscard]] static std::string course(const char* what, double a, double b) {
    const std::string from = short_number(a), to = short_number(b);
    return from == to ? fmt::format("{} {} (unchanged)", what, to) : fmt::format("{} {} → {}", what, from, to);
  }
};

TEST_F(StepWindow, AVertexSaysHowFarItMovedAndWhatThatGained) {
  good("generate annulus 400");
  bool moved = false, stayed = false;
  for (int step = 0; step < 60 && !(moved && stayed); ++step) {
    const std::shared_ptr<const Frame> before = session()->frame;
    const Index visited = session()->runs[0].colouring->order[static_cast<std::size_t>(before->moment.visits)];
    good("step vertex");
    const std::shared_ptr<const Frame> after = session()->frame;
    const Vec3 way = after->positions[visited] - before->positions[visited];
    const std::string minimum = course("minimum", before->shown_statistics.minimum, after->shown_statistics.minimum);
    if (way.x == 0.0 && way.y == 0.0) {
      stayed = true;
      EXPECT_EQ(news().sentence, fmt::format("vertex {} stays: no place is better; {}", visited, minimum));
      EXPECT_EQ(news().vertex, visited);
      EXPECT_TRUE(news().moved.empty());
      continue;
    }
    moved = true;
    EXPECT_EQ(news().moved, std::vector<Index>{visited});
    EXPECT_TRUE(news().sentence.starts_with(fmt::format("vertex {} moved by ", visited))) << news().sentence;
    EXPECT_NE(news().sentence.find(" % of its mean edge; "), std::string::npos) << news().sentence;
    const std::string own = course("its worst element", static_cast<double>(worst_around(*before, visited)),
                                   static_cast<double>(worst_around(*after, visited)));
    EXPECT_TRUE(news().sentence.ends_with(own + "; " + minimum)) << news().sentence << "\n" << own << "\n" << minimum;
  }
  EXPECT_TRUE(moved);
}

TEST_F(StepWindow, AClassAndAnIterationSayHowManyMoved) {
  good("generate annulus 400");
  const auto input = session()->frame;
  good("step class");
  const Index classes = session()->runs[0].colouring->class_count();
  EXPECT_TRUE(news().sentence.starts_with(fmt::format("class 1 of {}: ", classes))) << news().sentence;
  good("step iteration");
  good("reset");
  EXPECT_EQ(news().sentence, "") << "that was no step forwards";
  const auto before = session()->frame;
  good("step iteration");
  const auto after = session()->frame;
  std::size_t moved = 0;
  for (std::size_t v = 0; v < after->positions.size(); ++v) moved += length(after->positions[v] - before->positions[v]) > 0.0 ? 1 : 0;
  EXPECT_EQ(news().sentence, fmt::format("iteration 1: {}; {}; {} of {} moved",
                                         course("minimum", before->shown_statistics.minimum, after->shown_statistics.minimum),
                                         course("mean", before->shown_statistics.mean, after->shown_statistics.mean), count(moved),
                                         counted(session()->runs[0].free_vertices, "vertex", "vertices")));
  good("back iteration");
  EXPECT_EQ(news().sentence, "");
}

TEST_F(StepWindow, TheStatusBarSaysItUntilSomethingElseIsSaid) {
  good("generate annulus 400");
  good("step iteration");
  EXPECT_EQ(news().messages, state().messages) << "it is the newest";
  add_message(state(), {Message::Kind::Info, "something else", 0});
  EXPECT_NE(news().messages, state().messages);
}

TEST_F(StepWindow, TheStatusBarShowsItWhole) {
  open(1920, 1080);  // has room for everything
  good("generate annulus 400");
  for (const char* step : {"step vertex", "step class", "key N"}) {
    good(step);
    ASSERT_FALSE(news().sentence.empty()) << step;
    EXPECT_TRUE(window_->app().items().boxes().contains("status-message")) << step;
    const bool iteration = session()->runs[0].moment.visits == 0;
    const auto said = window_->app().items().find("status-message");
    // Within an iteration it is whole, over the timeline; of iterations the facts have all that counts.
    if (iteration) continue;
    EXPECT_NEAR(said[2] - said[0], ImGui::CalcTextSize(news().sentence.c_str()).x, 1.0F) << step;
  }
}

TEST_F(StepWindow, ANarrowStatusBarEndsWithAWholeClause) {
  const auto width = [](const char* text) { return ImGui::CalcTextSize(text).x; };
  constexpr const char* kSaid = "iteration 1: minimum 0.07 → 0.5925; mean 0.9 (unchanged), 4,075 of 4,080 vertices moved";
  EXPECT_EQ(fit_clauses(kSaid, 1e4F), kSaid);
  EXPECT_EQ(fit_clauses(kSaid, width("iteration 1: minimum 0.07 → 0.5925; mean 0.9 (unchanged), 4,0")),
            "iteration 1: minimum 0.07 → 0.5925; mean 0.9 (unchanged)");
  EXPECT_EQ(fit_clauses(kSaid, width("iteration 1: minimum 0.07 → 0.5925; mean")), "iteration 1: minimum 0.07 → 0.5925");
  EXPECT_EQ(fit_clauses(kSaid, width("iteration 1: min")), "iteration 1");
  EXPECT_TRUE(fit_clauses(kSaid, width("iterat")).ends_with("…")) << "no clause fits";
  good("generate coast");
  good("step iteration");
  const auto said = window_->app().items().find("status-message");
  const std::string clause = news().sentence.substr(0, news().sentence.find(';'));
  EXPECT_NEAR(said[2] - said[0], width(clause.c_str()), 1.0F) << "at 1280 x 800: " << clause;
}

TEST_F(StepWindow, AFlashIsForAMomentAndOnlyWhereItIsAskedFor) {
  good("generate annulus 400");
  EXPECT_EQ(state().stepping.flash, Flash::Off) << "pictures of scripts are the same at any time";
  ViewState clock;
  clock.stepping.flash = Flash::On;
  StepWatch watch;
  SessionView view = *session();
  (void)watch.follow(clock, view, false, 10.0);
  good("step vertex");
  view = *session();
  double now = 20.0;
  double wait = watch.follow(clock, view, false, now);
  EXPECT_EQ(clock.stepping.flash_level, kFlashLevels);
  int before = kFlashLevels, changes = 0;
  while (wait < 1e9 && now < 30.0) {
    now += wait + 1e-6;
    wait = watch.follow(clock, view, false, now);
    EXPECT_LE(clock.stepping.flash_level, before);
    before = clock.stepping.flash_level;
    ++changes;
  }
  EXPECT_EQ(clock.stepping.flash_level, 0);
  EXPECT_GT(now, 20.6);
  EXPECT_LT(now, 20.8);
  EXPECT_LT(changes, 3 * kFlashLevels) << "drawn anew only when it changes";
}

TEST_F(StepWindow, HeldItIsInThePicture) {
  for (const char* mesh : {"generate annulus 400", "generate solids 64"}) {
    good(mesh);
    good("flash off");
    good("worst off");
    good("step iteration");
    const render::Image plain = window_->app().mesh_picture({});
    good("flash hold");
    const render::Image held = window_->app().mesh_picture({});
    EXPECT_NE(plain.rgba, held.rgba) << mesh;
    EXPECT_EQ(held.rgba, window_->app().mesh_picture({}).rgba);
    good("flash off");
    EXPECT_EQ(plain.rgba, window_->app().mesh_picture({}).rgba);
  }
}

TEST_F(StepWindow, ElementsThatMovedAreTintedAndNoOthers) {
  good("generate grid 100");
  for (const char* off : {"worst off", "wireframe off", "colormap viridis"}) good(off);
  good("step class");
  const auto pixel = [&](const render::Image& image, Index element) {
    const Frame& frame = *session()->frame;
    const auto corners = frame.input->mesh.elements.corners(element);
    Vec3 middle;
    for (const Index v : corners) middle = middle + 1.0 / static_cast<double>(corners.size()) * frame.positions[v];
    const PaneFacts& pane = window_->app().panes().front();
    const Vec2<double> at = *pane.view->place(ScenePoints::of(*frame.input).at(middle));
    return image.at(static_cast<int>(pane.rect.x + pane.rect.w / 2 + static_cast<float>(at.x)),
                    static_cast<int>(pane.rect.y + pane.rect.h / 2 - static_cast<float>(at.y)));
  };
  const render::Image plain = window_->picture();
  good("flash hold");
  const render::Image held = window_->picture();
  std::vector<std::uint8_t> touched(session()->frame->element_count(), 0);
  for (Index e = 0; e < touched.size(); ++e)
    for (const Index v : session()->frame->input->mesh.elements.corners(e))
      touched[e] = touched[e] != 0 || std::ranges::find(news().moved, v) != news().moved.end() ? 1 : 0;
  ASSERT_GT(std::ranges::count(touched, 1), 10);
  ASSERT_GT(std::ranges::count(touched, 0), 10);
  for (Index e = 0; e < touched.size(); ++e) {
    const auto before = pixel(plain, e), now = pixel(held, e);
    if (touched[e] == 0) {
      EXPECT_EQ(now, before) << e;
    } else {  // 45 % of the way to the text's colour
      EXPECT_NEAR(now.b, before.b + 0.45 * (ui::palette(Theme::Dark).text.b - before.b), 3.0) << e;
      EXPECT_NEAR(now.r, before.r + 0.45 * (ui::palette(Theme::Dark).text.r - before.r), 3.0) << e;
    }
  }
}

}  // namespace
}  // namespace dmoscope::ui
