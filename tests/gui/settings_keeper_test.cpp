#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "ui/commands/settings.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

class KeptSettings : public ::testing::Test {
 protected:
  [[nodiscard]] static ViewState read(const std::filesystem::path& settings, const std::filesystem::path& recent) {
    ViewState state;
    load_settings(settings, state);
    load_recent(recent, state);
    return state;
  }
  const test::TemporaryFolder folder_;
  const std::filesystem::path settings_ = folder_ / "config/settings.json", recent_ = folder_ / "state/recent.json";
};

TEST_F(KeptSettings, AreWrittenOnceTheyStandStill) {
  ViewState state;
  SettingsKeeper keeper;
  keeper.begin(settings_, recent_, state);
  EXPECT_TRUE(std::isinf(keeper.look(state, 1.0)));
  EXPECT_FALSE(std::filesystem::exists(settings_)) << "nothing has changed";
  state.theme = Theme::Light;
  EXPECT_GT(keeper.look(state, 2.0), 0.0);
  state.panels.left_width = 21;  // dragging the panel
  EXPECT_FALSE(std::isinf(keeper.look(state, 2.2)));
  EXPECT_FALSE(std::isinf(keeper.look(state, 2.4)));
  EXPECT_FALSE(std::filesystem::exists(settings_));
  EXPECT_TRUE(std::isinf(keeper.look(state, 2.2 + 1.01 * SettingsKeeper::kStill)));
  const ViewState now = read(settings_, recent_);
  EXPECT_EQ(now.theme, Theme::Light);
  EXPECT_EQ(now.panels.left_width, 21);
}

TEST_F(KeptSettings, TheWindowsPlaceIsAmongThem) {
  ViewState state;
  SettingsKeeper keeper;
  keeper.begin(settings_, recent_, state);
  state.place = {1000, 700, true};
  EXPECT_TRUE(keeper.write(state).empty());
  EXPECT_EQ(read(settings_, recent_).place, (WindowPlace{1000, 700, true}));
}

TEST_F(KeptSettings, RecentFilesAreWrittenAtOnceAndOthersStay) {
  ViewState one, two;
  SettingsKeeper first, second;
  first.begin(settings_, recent_, one);
  second.begin(settings_, recent_, two);
  remember_file(one, "/a/x.14");
  EXPECT_TRUE(std::isinf(first.look(one, 1.0)));
  remember_file(two, "/b/y.14");
  EXPECT_TRUE(std::isinf(second.look(two, 1.0)));
  EXPECT_EQ(read(settings_, recent_).recent_files, (std::vector<std::string>{"/b/y.14", "/a/x.14"}));
}

TEST_F(KeptSettings, RecentFilesAreWholePaths) {
  ViewState state;
  remember_file(state, "some/../mesh.off");
  EXPECT_EQ(state.recent_files, std::vector<std::string>{(std::filesystem::current_path() / "mesh.off").string()});
  std::filesystem::create_directories(folder_ / "real");
  std::filesystem::create_directory_symlink(folder_ / "real", folder_ / "link");
  std::ofstream(folder_ / "real/m.off") << "OFF";
  remember_file(state, (folder_ / "real/m.off").string());
  remember_file(state, (folder_ / "link/m.off").string());
  EXPECT_EQ(state.recent_files.size(), 2U) << "one file by two ways";
  EXPECT_TRUE(apply_recent(R"(["typed.14", "/whole.14"])", state));
  EXPECT_EQ(state.recent_files, std::vector<std::string>{"/whole.14"});
}

TEST_F(KeptSettings, WhatCannotBeWrittenIsSaid) {
  std::ofstream(folder_ / "config") << "no folder";
  ViewState state;
  SettingsKeeper keeper;
  keeper.begin(settings_, recent_, state);
  state.theme = Theme::Light;
  (void)keeper.look(state, 1.0);
  (void)keeper.look(state, 2.0);
  ASSERT_FALSE(state.log.empty());
  EXPECT_NE(state.log.back().text.find("settings"), std::string::npos);
}

TEST(RecentLabels, FoldersTellTheSameNamesApart) {
  const std::vector<std::string> files{"/m/a/east.14", "/m/b/east.14", "/m/tire.vtk", "/n/b/east.14"};
  EXPECT_EQ(short_names(files), (std::vector<std::string>{"east.14   a", "east.14   /m/b", "tire.vtk", "east.14   /n/b"}));
  EXPECT_EQ(short_names(std::vector<std::string>{"/east.14", "/b/east.14"}), (std::vector<std::string>{"east.14   /", "east.14   /b"}));
}

}  // namespace
}  // namespace dmoscope::ui
