#include "ui/commands/view_commands.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "core/engine/engine.h"
#include "ui/commands/settings.h"
#include "ui/state/format.h"
#include "ui/toolkit/file_browser.h"

namespace dmoscope::ui {
namespace {

/// The commands on plain state, with a session of nine vertices and the lines posted to it.
class ViewCommands : public testing::Test {
 protected:
  ViewCommands() {
    host_.session = [this] { return session_; };
    host_.post = [this](std::string line) { posted_.push_back(std::move(line)); };
    host_.busy = [this] { return busy_; };
    host_.cancel = [this] { cancelled_ = true; };
    host_.item = [](const std::string& name) -> std::array<float, 4> {
      if (name != "step") throw UsageError("no item " + name);
      return {10, 20, 30, 60};
    };
    table_ = view_commands(state_, host_);
  }
  void run(std::string_view line) { dispatch(table_, host_, line); }
  void open_grid() {
    Engine engine(1);
    engine.post("generate grid 400");
    engine.wait_idle();
    session_ = engine.view();
    ASSERT_NE(session_->frame, nullptr);
  }

  ViewState state_;
  CommandHost host_;
  CommandTable table_;
  std::shared_ptr<const SessionView> session_ = std::make_shared<SessionView>();
  std::vector<std::string> posted_;
  bool busy_ = false, cancelled_ = false;
};

TEST_F(ViewCommands, SessionVerbsArePassedOn) {
  run("step class 3");
  run("  # a comment");
  run("");
  EXPECT_EQ(posted_, std::vector<std::string>{"step class 3"});
  EXPECT_THROW(run("frobnicate"), UsageError);
}

TEST_F(ViewCommands, OfAnUnknownCommandTheClosestIsNamedWhoseverItIs) {
  const auto refusal = [&](std::string_view line) -> std::string {
    try {
      require_known_command(table_, line);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal("wirefame on"), "unknown command 'wirefame'; did you mean wireframe?");  // a command of the view
  EXPECT_EQ(refusal("setp class"), "unknown command 'setp'; did you mean step?");            // a command of the session
  EXPECT_EQ(refusal("frobnicate"), "unknown command 'frobnicate'");
  EXPECT_EQ(refusal("step class"), "");
  EXPECT_EQ(refusal("wireframe on"), "");
  EXPECT_EQ(refusal("# wirefame"), "");
  EXPECT_THROW(run("setp class"), UsageError);
  EXPECT_TRUE(posted_.empty());
}

TEST_F(ViewCommands, SwitchesSwitch) {
  run("wireframe off");
  EXPECT_FALSE(state_.wireframe);
  run("wireframe toggle");
  EXPECT_TRUE(state_.wireframe);
  EXPECT_THROW(run("wireframe perhaps"), UsageError);
  run("theme light");
  EXPECT_EQ(state_.theme, Theme::Light);
  run("theme next");
  EXPECT_EQ(state_.theme, Theme::Contrast);
  EXPECT_THROW(run("theme pink"), UsageError);
  run("panel right off");
  EXPECT_FALSE(state_.panels.facts);
  run("plot histogram");
  EXPECT_EQ(state_.plot, PlotTab::Histogram);
  run("log-scale on");
  EXPECT_EQ(state_.plot_view().axis, ValueAxis::Log);
  run("colormap cividis");
  EXPECT_EQ(state_.colour_map, render::ColourMap::Cividis);
  EXPECT_THROW(run("colormap rainbow"), UsageError);
  run("scale 2");
  EXPECT_EQ(state_.scale, 2.0);
  run("scale 99");
  EXPECT_EQ(state_.scale, 4.0);
  EXPECT_THROW(run("scale -1"), UsageError);
}

TEST_F(ViewCommands, RangesAreChecked) {
  run("range 0.2 0.8");
  EXPECT_EQ(colour_range(state_, std::nullopt), (std::pair{0.2, 0.8}));
  EXPECT_THROW(run("range 0.8 0.2"), UsageError);
  EXPECT_EQ(colour_range(state_, std::nullopt), (std::pair{0.2, 0.8}));
  run("range fixed");
  EXPECT_EQ(colour_range(state_, std::nullopt), (std::pair{0.0, 1.0}));
}

TEST_F(ViewCommands, PicksMustExist) {
  EXPECT_THROW(run("pick vertex 0"), UsageError);
  open_grid();
  run("pick vertex 3");
  EXPECT_EQ(state_.picked, (Picked{Picked::Kind::Vertex, 3}));
  EXPECT_THROW(run("pick vertex 123456789"), UsageError);
  EXPECT_EQ(state_.picked, (Picked{Picked::Kind::Vertex, 3}));
  run("pick none");
  EXPECT_EQ(state_.picked.kind, Picked::Kind::None);
}

TEST_F(ViewCommands, GoToPutsTheElementInTheMiddle) {
  open_grid();
  run("goto element 5");
  EXPECT_EQ(state_.picked, (Picked{Picked::Kind::Element, 5}));
  Vec2<double> low{1e300, 1e300}, high{-1e300, -1e300};
  for (const Index corner : session_->input->mesh.elements.corners(5)) {
    const auto p = session_->input->geometry.plane.project(session_->frame->positions[corner]);
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const auto pixel = state_.camera.to_pixel({(low.x + high.x) / 2, (low.y + high.y) / 2}, state_.viewport);
  EXPECT_NEAR(pixel.x, state_.viewport.x / 2, 1.0);
  EXPECT_NEAR(pixel.y, state_.viewport.y / 2, 1.0);
}

TEST_F(ViewCommands, SpaceRunsOrStops) {
  run("run-pause");
  EXPECT_EQ(posted_, std::vector<std::string>{"until-converged best"});
  busy_ = true;
  run("run-pause");
  EXPECT_TRUE(cancelled_);
  EXPECT_EQ(posted_.size(), 1U);
}

TEST_F(ViewCommands, ScreenshotsKnowTheirOptions) {
  run("screenshot \"a b.png\" --size 640x480 --supersample 4 --transparent");
  ASSERT_EQ(state_.requests.screenshots.size(), 1U);
  const ScreenshotOptions& shot = state_.requests.screenshots[0];
  EXPECT_EQ(shot.path, "a b.png");
  EXPECT_EQ(shot.width, 640);
  EXPECT_EQ(shot.height, 480);
  EXPECT_EQ(shot.supersample, 4);
  EXPECT_TRUE(shot.transparent);
  EXPECT_THROW(run("screenshot"), UsageError);
  EXPECT_THROW(run("screenshot x.png --size 0x7"), UsageError);
  EXPECT_THROW(run("screenshot x.jpg"), UsageError) << "its bytes would be a PNG's";
  EXPECT_THROW(run("screenshot x.png --size 12"), UsageError);
  EXPECT_THROW(run("screenshot x.png --supersample 9"), UsageError);
  EXPECT_THROW(run("screenshot x.png y.png"), UsageError);
}

TEST_F(ViewCommands, AClickIsMovePressRelease) {
  run("click step");
  ASSERT_EQ(state_.requests.input.size(), 4U);
  EXPECT_EQ(state_.requests.input[0].x, 20);
  EXPECT_EQ(state_.requests.input[0].y, 40);
  EXPECT_EQ(state_.requests.input[2].kind, SimulatedInput::Kind::Press);
  EXPECT_EQ(state_.requests.input[3].kind, SimulatedInput::Kind::Release);
  EXPECT_THROW(run("click nowhere"), UsageError);
  EXPECT_THROW(run("key Nonsense"), UsageError);
}

TEST(ViewState, ErrorsOpenADialogAndTheLogIsLimited) {
  ViewState state;
  add_message(state, {Message::Kind::Info, "hello", 0});
  EXPECT_EQ(state.dialog, Dialog::None);
  add_message(state, {Message::Kind::Error, "first", 3});
  add_message(state, {Message::Kind::Error, "second", 3});
  EXPECT_EQ(state.dialog, Dialog::Error);
  EXPECT_EQ(state.error_text, "first\n\nsecond");
  for (int k = 0; k < 1000; ++k) add_message(state, {Message::Kind::Info, "x", 0});
  EXPECT_LE(state.log.size(), 200U);
}

TEST(Settings, ComeBackAsTheyWereAndNonsenseIsIgnored) {
  ViewState state;
  state.theme = Theme::Light;
  state.scale = 1.5;
  state.panels.setup = false;
  remember_file(state, "/a/b.vtk");
  remember_file(state, "/c/d.14");
  remember_file(state, "/a/b.vtk");
  ViewState read;
  ASSERT_TRUE(apply_settings(settings_text(state), read));
  ASSERT_TRUE(apply_recent(recent_text(state), read));
  EXPECT_EQ(read.theme, Theme::Light);
  EXPECT_EQ(read.scale, 1.5);
  EXPECT_FALSE(read.panels.setup);
  EXPECT_EQ(read.recent_files, (std::vector<std::string>{"/a/b.vtk", "/c/d.14"}));
  ViewState plain;
  EXPECT_FALSE(apply_settings("not json", plain));
  EXPECT_FALSE(apply_settings("[1, 2]", plain));
  EXPECT_FALSE(apply_recent("{}", plain));
  EXPECT_TRUE(apply_recent(R"([1, "/a", {}])", plain));
  EXPECT_EQ(plain.recent_files, std::vector<std::string>{"/a"});
  EXPECT_TRUE(apply_settings(R"({"theme": 7, "scale": "big", "panels": 3, "colormap": "none"})", plain));
  EXPECT_EQ(plain.theme, Theme::Dark);
  EXPECT_EQ(plain.scale, 1.0);
}

TEST(Settings, TheScaleIsOverTheMonitorsAndFollowsTheWindow) {
  ViewState state;
  move_to_monitor(state, 2.0);
  EXPECT_EQ(state.scale, 2.0);
  state.scale *= 1.25;
  move_to_monitor(state, 1.0);
  EXPECT_EQ(state.scale, 1.25);
  ViewState other;
  move_to_monitor(other, 1.5);
  ASSERT_TRUE(apply_settings(settings_text(state), other));
  EXPECT_EQ(other.scale, 1.875);
  move_to_monitor(other, 0.0);  // no monitor gives a scale
  EXPECT_EQ(other.monitor_scale, 1.5);
}

TEST(Settings, ABrokenFileIsNeverFatal) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "dmoscope settings";
  std::filesystem::remove_all(folder);
  ViewState state;
  load_settings(folder / "none.json", state);
  EXPECT_TRUE(state.log.empty());
  EXPECT_EQ(save_settings(folder / "deep" / "settings.json", state), "");
  EXPECT_TRUE(std::filesystem::exists(folder / "deep" / "settings.json"));
  std::ofstream(folder / "broken.json") << "{{{";
  load_settings(folder / "broken.json", state);
  EXPECT_EQ(state.log.size(), 1U);
  EXPECT_EQ(state.dialog, Dialog::None);
  EXPECT_NE(save_settings("/proc/no/such/place/settings.json", state), "");
}

TEST(FileBrowser, ListsFoldersFirstThenMeshes) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "dmoscope browser";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder / "zebra");
  for (const char* name : {"b.VTK", "a.off", "notes.txt", ".hidden.vtk"}) std::ofstream(folder / name) << "x";
  std::string error;
  const auto meshes = list_folder(folder, false, error);
  ASSERT_EQ(meshes.size(), 3U);
  EXPECT_EQ(meshes[0].name, "zebra");
  EXPECT_TRUE(meshes[0].folder);
  EXPECT_EQ(meshes[1].name, "a.off");
  EXPECT_EQ(meshes[2].name, "b.VTK");
  EXPECT_EQ(list_folder(folder, true, error).size(), 4U);
  EXPECT_TRUE(error.empty());
  EXPECT_TRUE(list_folder(folder / "none", false, error).empty());
  EXPECT_FALSE(error.empty());
  EXPECT_EQ(parent_folder("/a/b/"), "/a");
  EXPECT_EQ(parent_folder("/"), "/");
}

TEST(Format, FourSignificantDigits) {
  EXPECT_EQ(short_number(0.8), "0.8000");
  EXPECT_EQ(short_number(0.031237), "0.03124");
  EXPECT_EQ(short_number(1.0), "1.000");
  EXPECT_EQ(short_number(-0.5), "-0.5000");
  EXPECT_EQ(short_number(4728.4), "4728") << "no digit that is not known";
  EXPECT_EQ(short_number(999.96), "1000");
  EXPECT_EQ(short_number(99.999), "100.0");
  EXPECT_EQ(short_number(37770.0), "3.777e+04");
  EXPECT_EQ(short_number(INFINITY), "–");
  EXPECT_EQ(full_number(0.1), "0.1");
  EXPECT_EQ(count(0), "0");
  EXPECT_EQ(count(999), "999");
  EXPECT_EQ(count(1334112), "1,334,112");
}

}  // namespace
}  // namespace dmoscope::ui
