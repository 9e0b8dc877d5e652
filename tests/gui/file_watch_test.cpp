#include "ui/toolkit/file_watch.h"

#include <chrono>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>

#include "ui/toolkit/file_browser.h"

namespace dmoscope::ui {
namespace {

FileStamp stamp(int seconds, std::uintmax_t size) { return {std::filesystem::file_time_type(std::chrono::seconds(seconds)), size}; }

TEST(ChangeJudge, WaitsUntilAFileHasComeToRest) {
  ChangeJudge judge;
  judge.start(stamp(1, 100));
  EXPECT_FALSE(judge.look(stamp(1, 100), 0.0));
  EXPECT_FALSE(judge.look(stamp(2, 40), 1.0));  // the file is being written
  EXPECT_TRUE(judge.expecting());
  EXPECT_FALSE(judge.look(stamp(2, 80), 1.4));
  EXPECT_FALSE(judge.look(stamp(2, 80), 1.8));
  EXPECT_TRUE(judge.look(stamp(2, 80), 1.9));
  EXPECT_FALSE(judge.look(stamp(2, 80), 2.9));  // reported only once
  EXPECT_FALSE(judge.expecting());
}

TEST(ChangeJudge, AFileThatGoesAndComesBackIsNewAndOneThatIsTheSameIsNot) {
  ChangeJudge judge;
  judge.start(stamp(1, 100));
  EXPECT_FALSE(judge.look(std::nullopt, 1.0));
  EXPECT_FALSE(judge.look(stamp(1, 100), 2.0));
  EXPECT_FALSE(judge.look(stamp(1, 100), 3.0));
  EXPECT_FALSE(judge.look(std::nullopt, 4.0));
  EXPECT_FALSE(judge.look(stamp(5, 100), 5.0));
  EXPECT_TRUE(judge.look(stamp(5, 100), 6.0));
  // A file that did not exist when the watching began is new when it comes.
  judge.start(std::nullopt);
  EXPECT_FALSE(judge.look(stamp(5, 100), 7.0));
  EXPECT_TRUE(judge.look(stamp(5, 100), 8.0));
}

TEST(FileWatch, TellsOfAFileWrittenAnew) {
  const auto file = std::filesystem::path(testing::TempDir()) / "dmoscope watched.txt";
  std::ofstream(file) << "one";
  std::atomic<int> woken = 0;
  FileWatch watch([&woken] { ++woken; });
  EXPECT_FALSE(watch.take_change());
  watch.follow(file.string());
  // The known state is the one at the first look, which comes at once; a file system's clock may be coarse.
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  std::ofstream(file) << "another";
  bool changed = false;
  for (int k = 0; k < 600 && !changed; ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    changed = watch.take_change();
  }
  EXPECT_TRUE(changed);
  EXPECT_EQ(woken, 1);
  watch.follow({});
  EXPECT_FALSE(watch.take_change());
}

TEST(RecentFiles, KnowWhatIsMissingAndAskOnlyNowAndThen) {
  const auto file = std::filesystem::path(testing::TempDir()) / "dmoscope recent.txt";
  std::ofstream(file) << "x";
  RecentFiles recent;
  const std::vector<std::string> files{file.string(), "/no/such/file.off"};
  EXPECT_FALSE(recent.list(files, 0.0)[0].missing);
  EXPECT_TRUE(recent.list(files, 0.0)[1].missing);
  EXPECT_NE(recent.list(files, 0.0)[1].reason(), "");
  std::filesystem::remove(file);
  EXPECT_FALSE(recent.list(files, 1.0)[0].missing);
  EXPECT_TRUE(recent.list(files, 3.0)[0].missing);
  EXPECT_EQ(recent.list({"/no/such/file.off"}, 3.1).size(), 1U);
}

}  // namespace
}  // namespace dmoscope::ui
