// Dialogs that open and save: the program's own, and the desktop's by a stand-in on the path.
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/gui/headless_test.h"
#include "tests/support/temporary_folder.h"
#include "ui/commands/settings.h"
#include "ui/state/save_target.h"
#include "ui/toolkit/file_chooser.h"

namespace dmoscope::app {
namespace {

namespace fs = std::filesystem;
using ui::Dialog;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

class FileDialogs : public HeadlessTest {
 protected:
  void TearDown() override { window_.reset(); }
  [[nodiscard]] fs::path at(const std::string& name) const { return folder_.path() / name; }
  void open_mesh(const std::string& name) {
    good("generate annulus");
    good("export \"" + at(name).string() + "\"");
    good("open \"" + at(name).string() + "\"");
  }
  void type_into(const std::string& item, const std::string& text) {
    good("click " + item);
    good("key Ctrl+A");
    good("type \"" + text + "\"");
  }
  [[nodiscard]] bool shows(const std::string& item) { return window_->app().items().boxes().contains(item); }
  test::TemporaryFolder folder_;
};

TEST_F(FileDialogs, EachSavesBesideTheOpenMesh) {
  fs::create_directories(at("deep"));
  open_mesh("deep/a.off");
  good("dialog export");
  good("click export:go");
  EXPECT_TRUE(fs::exists(at("deep/a-smoothed.off")));
  good("dialog screenshot");
  good("click screenshot:go");
  EXPECT_TRUE(fs::exists(at("deep/a.png")));
  good("dialog save-session");
  good("click session:go");
  EXPECT_TRUE(fs::exists(at("deep/a.dmoscope")));
  good("step iteration");
  good("dialog plot");
  good("click plot:go");
  EXPECT_TRUE(fs::exists(at("deep/a-plot.svg")));
  EXPECT_EQ(state().dialog, Dialog::None);
}

TEST_F(FileDialogs, EnterAloneReplacesNothing) {
  open_mesh("a.off");
  std::ofstream(at("kept.off")) << "kept";
  good("dialog export");
  type_into("export:file", "kept.off");
  good("key Enter");
  EXPECT_EQ(state().dialog, Dialog::Export);
  EXPECT_TRUE(shows("export:replace"));
  for (int k = 0; k < 3; ++k) good("key Enter");
  EXPECT_EQ(text_of(at("kept.off")), "kept");
  EXPECT_EQ(state().dialog, Dialog::Export);
  type_into("export:file", "other.off");  // another name needs another question
  EXPECT_FALSE(shows("export:replace"));
  type_into("export:file", "kept.off");
  good("key Enter");
  good("click export:replace");
  EXPECT_EQ(state().dialog, Dialog::None);
  EXPECT_NE(text_of(at("kept.off")), "kept");
  good("dialog export");  // the answer held only once
  good("key Enter");
  EXPECT_EQ(state().dialog, Dialog::Export);
  EXPECT_TRUE(shows("export:replace"));
}

TEST_F(FileDialogs, ARefusedNameStaysWithTheReason) {
  open_mesh("a.off");
  good("dialog export");
  for (const char* name : {"none/such/x.off", "x.docx", "x.stepfile"}) {
    type_into("export:file", name);
    good("key Enter");
    ASSERT_EQ(state().dialog, Dialog::Export) << name;
    good("click export:file");
    good("key Ctrl+A");
    good("key Ctrl+C");
    EXPECT_EQ(window_->clipboard(), name);
  }
  type_into("export:file", "/proc/x.off");  // a file that fails only when it is written
  (void)window_->run("key Enter");
  ASSERT_EQ(state().dialog, Dialog::Error);
  good("key Escape");
  good("dialog export");
  good("click export:file");
  good("key Ctrl+A");
  good("key Ctrl+C");
  EXPECT_EQ(window_->clipboard(), "/proc/x.off");
}

TEST_F(FileDialogs, TheFormatChoosesTheEndingAndANameWithoutOneGetsIt) {
  open_mesh("a.off");
  good("dialog export");
  good("click export:format");
  good("click export:vtk");
  type_into("export:file", "bare");
  good("key Enter");
  EXPECT_TRUE(fs::exists(at("bare.off")));
  good("dialog export");
  good("click export:format");
  good("click export:obj");
  good("click export:go");
  EXPECT_TRUE(fs::exists(at("bare.obj")));
  good("dialog screenshot");
  type_into("screenshot:file", "shot.jpg");
  good("key Enter");
  EXPECT_EQ(state().dialog, Dialog::Screenshot);
  type_into("screenshot:file", "shot");
  good("key Enter");
  EXPECT_TRUE(fs::exists(at("shot.png")));
}

TEST_F(FileDialogs, BrowseGoesThroughFoldersAndPlaces) {
  fs::create_directories(at("b/c"));
  open_mesh("a.off");
  good("dialog export");
  good("click export:browse");
  good("click entry:b");
  good("click entry:c");
  good("click export:go");
  EXPECT_TRUE(fs::exists(at("b/c/a-smoothed.off")));
  good("dialog export");
  good("click export:folder");
  good("click place:0");  // the folder of the mesh
  good("click export:go");
  EXPECT_TRUE(fs::exists(at("a-smoothed.off")));
}

TEST_F(FileDialogs, OpenBeginsBesideTheMeshAndHasPlaces) {
  fs::create_directories(at("one"));
  open_mesh("one/a.off");
  good("dialog open");
  EXPECT_TRUE(shows("entry:a.off"));
  EXPECT_TRUE(shows("place:0"));
  good("click open:path");
  good("key Ctrl+A");
  good("key Ctrl+C");
  EXPECT_EQ(window_->clipboard(), at("one").string());
}

TEST(SaveTarget, KnowsWholePathsAndWhatStandsInTheWay) {
  const test::TemporaryFolder folder;
  ui::SaveTarget target;
  target.set_path(folder.path() / "x");
  EXPECT_EQ(judge(target, {"a picture", {".png"}}), ui::SaveVerdict::Ready);
  EXPECT_EQ(target.path(), folder.path() / "x.png");
  std::ofstream(target.path()) << "there";
  EXPECT_EQ(judge(target, {"a picture", {".png"}}), ui::SaveVerdict::Asks);
  target.replaced = target.asked;
  EXPECT_EQ(judge(target, {"a picture", {".png"}}), ui::SaveVerdict::Ready);
  target.name = "y.gif";
  EXPECT_EQ(judge(target, {"a picture", {".png"}}), ui::SaveVerdict::Refused);
  EXPECT_NE(target.trouble.find(".png"), std::string::npos) << target.trouble;
  target.name = "../" + folder.path().filename().string();
  EXPECT_EQ(judge(target, {"a picture", {".png"}}), ui::SaveVerdict::Refused);
  target.name = "m.vtu.gz";
  EXPECT_EQ(judge(target, {"a mesh", {".off"}, true}), ui::SaveVerdict::Ready);
}

/// Puts a program with the name zenity or kdialog first on the path.
class DesktopsDialog : public FileDialogs {
 protected:
  void SetUp() override {
    const char* path = std::getenv("PATH");
    path_ = path == nullptr ? "" : path;
    ::setenv("PATH", (folder_.path() / "bin").c_str(), 1);
    ::setenv("PATH", ((folder_.path() / "bin").string() + ":" + path_).c_str(), 1);
    fs::create_directories(folder_.path() / "bin");
    try {
      window_ = std::make_unique<HeadlessWindow>(HeadlessWindow::Options{.threads = 1, .native_dialogs = true, .sample_pictures = false});
    } catch (const Error& error) {
      GTEST_SKIP() << "no OpenGL without a screen: " << error.what();
    }
  }
  void TearDown() override {
    window_.reset();
    ::setenv("PATH", path_.c_str(), 1);
    ::unsetenv("XDG_CURRENT_DESKTOP");
  }
  void stand_in(const std::string& name, const std::string& body) {
    const fs::path file = folder_.path() / "bin" / name;
    std::ofstream(file) << "#!/bin/sh\nfor word in \"$@\"; do echo \"$word\"; done > '" << at(name + ".args").string() << "'\n"
                        << body << "\n";
    fs::permissions(file, fs::perms::owner_all);
  }
  /// Draws frames until a condition holds, while the stand-in runs in its own time.
  template <class Wanted>
  [[nodiscard]] bool comes(const Wanted& wanted) {
    for (int k = 0; k < 500; ++k) {
      window_->settle();
      if (wanted()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }
  std::string path_;
};

TEST_F(DesktopsDialog, ItsDialogOpensTheFileThatIsChosen) {
  open_mesh("a.off");
  good("generate grid");
  stand_in("zenity", "echo '" + at("a.off").string() + "'");
  good("key Ctrl+O");
  EXPECT_EQ(state().dialog, Dialog::None);
  EXPECT_TRUE(comes([&] { return session()->input && session()->input->path == at("a.off"); }));
  const std::string words = text_of(at("zenity.args"));
  EXPECT_NE(words.find("--file-selection\n"), std::string::npos) << words;
  EXPECT_NE(words.find("*.off"), std::string::npos) << words;
}

TEST_F(DesktopsDialog, AllFilesThatAreChosenAreOpenedBesideEachOther) {
  open_mesh("a.off");
  open_mesh("b and c.off");
  good("generate grid");
  stand_in("zenity", fmt::format("echo '{}'; echo '{}'", at("a.off").string(), at("b and c.off").string()));
  good("key Ctrl+O");
  EXPECT_TRUE(comes([&] { return session()->meshes.size() == 2; }));
  ASSERT_EQ(session()->meshes.size(), 2U);
  EXPECT_EQ(session()->meshes[0].input->path, at("a.off"));
  EXPECT_EQ(session()->meshes[1].input->path, at("b and c.off"));
  EXPECT_NE(text_of(at("zenity.args")).find("--multiple\n"), std::string::npos);
  stand_in("zenity", "sleep 0.3; exit 1");
  good("dialog open-surface");
  EXPECT_TRUE(comes([&] { return text_of(at("zenity.args")).find("--multiple") == std::string::npos; })) << "a surface is one";
}

TEST_F(DesktopsDialog, TheWindowGoesOnWhileItIsOpenAndEndsIt) {
  open_mesh("a.off");
  stand_in("zenity", fmt::format("echo $$ > '{}'; exec sleep 1000", at("pid").string()));
  good("key Ctrl+O");
  ASSERT_TRUE(comes([&] { return !text_of(at("pid")).empty(); }));
  good("key N");
  EXPECT_EQ(session()->frame->moment.iteration, 0U) << "what is typed while it comes is meant for it";
  good("click step-iteration");
  EXPECT_EQ(session()->frame->moment.iteration, 1U);
  const std::string words = text_of(at("zenity.args"));
  EXPECT_NE(words.find("--filename=" + folder_.path().string() + "/"), std::string::npos) << words;  // the folder of the mesh
  const int pid = std::stoi(text_of(at("pid")));
  EXPECT_TRUE(fs::exists(fmt::format("/proc/{}", pid)));
  window_.reset();
  EXPECT_FALSE(fs::exists(fmt::format("/proc/{}", pid)));
}

TEST_F(DesktopsDialog, CancelledItLeavesAllAsItWas) {
  open_mesh("a.off");
  stand_in("zenity", fmt::format("sleep 0.3; touch '{}'; exit 1", at("ended").string()));
  const auto before = session();
  good("key Ctrl+O");
  ASSERT_TRUE(comes([&] { return fs::exists(at("ended")); }));
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  window_->settle();
  EXPECT_EQ(session()->input, before->input);
  EXPECT_EQ(state().dialog, Dialog::None);
  good("key N");
  EXPECT_EQ(session()->frame->moment.iteration, 1U) << "and keys are commands again";
}

TEST_F(DesktopsDialog, WhereItDoesNotOpenOursDoes) {
  open_mesh("a.off");
  stand_in("zenity", "exit 255");
  good("key Ctrl+O");
  EXPECT_TRUE(comes([&] { return state().dialog == Dialog::Open; }));
  EXPECT_TRUE(shows("entry:a.off"));
}

TEST_F(DesktopsDialog, BrowseOfOursTakesItsPathAndAsksNoSecondTime) {
  open_mesh("a.off");
  std::ofstream(at("old.off")) << "old";
  stand_in("zenity", "echo '" + at("old.off").string() + "'");
  good("dialog export");
  good("click export:browse");
  const auto chosen = [&] {
    good("click export:file");
    good("key Ctrl+A");
    good("key Ctrl+C");
    return window_->clipboard() == "old.off";
  };
  ASSERT_TRUE(comes(chosen));
  EXPECT_NE(text_of(at("zenity.args")).find("--confirm-overwrite"), std::string::npos);
  good("click export:go");
  EXPECT_EQ(state().dialog, Dialog::None);
  EXPECT_NE(text_of(at("old.off")), "old");
}

TEST_F(DesktopsDialog, OnKdeItIsKdialog) {
  stand_in("zenity", "exit 1");
  stand_in("kdialog", "exit 1");
  EXPECT_EQ(ui::chooser_program().filename(), "zenity");
  ::setenv("XDG_CURRENT_DESKTOP", "KDE", 1);
  EXPECT_EQ(ui::chooser_program().filename(), "kdialog");
  const auto words = ui::chooser_arguments("/usr/bin/kdialog", {true, "Save", "/tmp", "a.off", "meshes", {".off", ".obj"}});
  EXPECT_EQ(words, (std::vector<std::string>{"/usr/bin/kdialog", "--title", "Save", "--getsavefilename", "/tmp/a.off",
                                             "meshes (*.off *.obj)\nall files (*)"}));
}

TEST_F(DesktopsDialog, TheSettingIsRememberedAndTurnsItOff) {
  open_mesh("a.off");
  stand_in("zenity", "exit 1");
  good("native-dialogs off");
  ui::ViewState other;
  ASSERT_TRUE(ui::apply_settings(ui::settings_text(state()), other));
  EXPECT_FALSE(other.native_dialogs);
  good("key Ctrl+O");
  EXPECT_EQ(state().dialog, Dialog::Open);
  EXPECT_FALSE(fs::exists(at("zenity.args")));
}

}  // namespace
}  // namespace dmoscope::app
