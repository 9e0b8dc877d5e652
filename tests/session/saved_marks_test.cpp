// Detection of unsaved runs: exactly those whose moves are in no file.
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "core/io/mesh_io.h"
#include "core/session/read_files.h"
#include "tests/session/spoken_session.h"
#include "tests/support/temporary_folder.h"

namespace dmoscope {
namespace {

class SavedMarksTest : public testing::SpokenSession {
 protected:
  [[nodiscard]] bool lost(std::size_t run = 0) { return session_.would_lose(run); }
  [[nodiscard]] std::string file(const std::string& name) { return (folder_ / name).string(); }
  static std::string text_of(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  const test::TemporaryFolder folder_;
};

TEST_F(SavedMarksTest, WhatHasMovedIsLostUntilItIsUndoneOrReset) {
  say("generate coast 300");
  EXPECT_FALSE(lost());
  say("step vertex");
  EXPECT_TRUE(lost());
  say("undo");
  EXPECT_FALSE(lost());
  say("redo");
  EXPECT_TRUE(lost());
  say("run 3");
  EXPECT_TRUE(lost());
  say("reset");
  EXPECT_FALSE(lost());
}

TEST_F(SavedMarksTest, AnExportKeepsThisMomentOfThisRun) {
  say("generate coast 300");
  say("run 2");
  say("add-run laplace");
  say("run 1");
  say("export " + file("a.off"));
  EXPECT_TRUE(lost(0));
  EXPECT_FALSE(lost(1));
  say("step iteration");
  EXPECT_TRUE(lost(1));
  say("back iteration");
  EXPECT_FALSE(lost(1));
  say("select-run 1");
  say("export " + file("b.off"));
  EXPECT_FALSE(lost(0));
  EXPECT_FALSE(lost(1));
  say("export " + file("a.off"));  // the file contained the other one
  EXPECT_FALSE(lost(0));
  EXPECT_TRUE(lost(1));
}

TEST_F(SavedMarksTest, ASavedSessionKeepsAllRunsAndTheirEdits) {
  say("generate coast 300");
  say("run 1");
  say("add-run laplace");
  say("run 2");
  say("save-state " + file("a.dmoscope"));
  EXPECT_FALSE(lost(0) || lost(1));
  Index free = 0;
  while (!session_.active().why_fixed(free).empty()) ++free;
  say("visit " + std::to_string(free));
  EXPECT_TRUE(lost(1));
  say("save-state " + file("a.dmoscope"));
  EXPECT_FALSE(lost(1));
  say("undo");
  EXPECT_TRUE(lost(1)) << "the file that held this moment was written over";
  say("redo");
  EXPECT_FALSE(lost(1)) << "the same visits again are the same bits";
  say("seek 0");  // the edit is still ahead, and in the file
  EXPECT_FALSE(lost(1));
  say("open-state " + file("a.dmoscope"));
  EXPECT_FALSE(lost(0) || lost(1));
}

TEST_F(SavedMarksTest, EditsAheadOfTheInputAreLost) {
  say("generate coast 300");
  Index free = 0;
  while (!session_.active().why_fixed(free).empty()) ++free;
  say("run 1");
  say("visit " + std::to_string(free));
  say("seek 0");
  EXPECT_TRUE(lost());
  say("reset");
  EXPECT_FALSE(lost());
}

TEST_F(SavedMarksTest, WhatWasRecoveredIsInNoFileOfAPerson) {
  say("generate coast 300");
  say("run 2");
  say("save-state " + file("a.dmoscope"));
  say("recover " + file("a.dmoscope"));
  EXPECT_TRUE(lost());
  EXPECT_EQ(context_.recovered, std::vector<std::filesystem::path>{file("a.dmoscope")});
}

TEST_F(SavedMarksTest, WritingOverTheInputKeepsACopyThatTheSessionIsOpenedFrom) {
  say("generate coast 300");
  say("export " + file("a.off"));
  const std::string before = text_of(folder_ / "a.off");
  say("open " + file("a.off"));
  say("run 2");
  EXPECT_TRUE(fails("export " + file("a.off")));
  EXPECT_TRUE(fails("export-over " + file("b.off")));
  say("export-over " + file("a.off"));
  EXPECT_NE(messages_.back().find("a.orig.off"), std::string::npos) << messages_.back();
  EXPECT_FALSE(lost());
  EXPECT_EQ(text_of(folder_ / "a.orig.off"), before);
  const std::string after = text_of(folder_ / "a.off");
  EXPECT_NE(after, before);
  say("run 1");
  say("export-over " + file("a.off"));
  EXPECT_EQ(text_of(folder_ / "a.orig.off"), before) << "the older copy stands";
  EXPECT_EQ(text_of(folder_ / "a.orig2.off"), after);
}

TEST_F(SavedMarksTest, ASessionOutlivesItsInputWrittenOver) {
  say("generate coast 300");
  say("export " + file("a.off"));
  say("open " + file("a.off"));
  say("run 2");
  say("export-over " + file("a.off"));
  const auto positions = session_.active().positions();
  const std::vector<Vec3> before(positions.begin(), positions.end());
  say("save-state " + file("a.dmoscope"));
  say("open-state " + file("a.dmoscope"));
  const auto after = session_.active().positions();
  EXPECT_EQ(std::vector<Vec3>(after.begin(), after.end()), before);
}

TEST(OriginalCopy, NamesKeepTheFormatsEnding) {
  EXPECT_EQ(original_name("/m/east.14", 1), "/m/east.orig.14");
  EXPECT_EQ(original_name("/m/a.vtk.gz", 2), "/m/a.orig2.vtk.gz");
  EXPECT_EQ(original_name("plain", 1), "plain.orig");
}

}  // namespace
}  // namespace dmoscope
