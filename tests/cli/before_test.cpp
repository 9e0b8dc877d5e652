// Compatibility with files of earlier versions: sessions, a checkpoint, scripts and command lines, in tests/data/before.

#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "core/base/words.h"
#include "tests/cli/program.h"

namespace dmoscope::test {
namespace {

/// Test on a copy of the files, whose path replaces FOLDER in their scripts.
class FilesOfBefore : public ::testing::Test {
 protected:
  FilesOfBefore() {
    std::filesystem::copy(DMOSCOPE_SOURCE_DIR "/tests/data/before", copy_);
    for (const char* script : {"commands.txt", "window.txt", "command_lines.txt"}) {
      constexpr std::string_view kName = "FOLDER";
      std::string text = read_file(path(script));
      for (std::size_t at = text.find(kName); at != std::string::npos; at = text.find(kName, at + copy_.string().size()))
        text.replace(at, kName.size(), copy_.string());
      std::ofstream(path(script), std::ios::binary) << text;
    }
  }

  [[nodiscard]] std::string path(const std::string& name) const { return (copy_ / name).string(); }
  /// Expects the program to succeed.
  static void done(const std::vector<std::string>& words, const std::string& input = {}) {
    Call call;
    call.arguments = words;
    call.input = input;
    const Output output = run(call);
    EXPECT_EQ(output.code, 0) << fmt::format("{}\n", fmt::join(words, " ")) << input << output.err;
  }

 private:
  Folder folder_;
  std::filesystem::path copy_ = folder_ / "before";
};

/// Sessions whose values.csv has the earlier program's report of every run, there and two iterations later.
class SessionsOfBefore : public FilesOfBefore {
 protected:
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& row : values_.rows)
      if (names.empty() || names.back() != row[0]) names.push_back(row[0]);
    return names;
  }
  /// Lines of a script that print every run of the session that is open.
  [[nodiscard]] std::string look(const std::string& name) const {
    std::string script;
    for (std::size_t row = 0; row < values_.rows.size(); ++row) {
      if (values_.rows[row][0] != name) continue;
      script += fmt::format("select-run {}\n", values_.rows[row][1]);
      for (const char* count : {"iteration", "inverted", "moved"})
        script += fmt::format("expect {} == {}\n", count, values_.number(row, count));
      for (const char* quality : {"minimum", "movable", "mean"}) script += near(quality, values_.number(row, quality));
    }
    return script;
  }
  /// Lines of a script that continue every run.
  [[nodiscard]] std::string go_on(const std::string& name) const {
    std::string script;
    for (std::size_t row = 0; row < values_.rows.size(); ++row) {
      if (values_.rows[row][0] != name) continue;
      script += fmt::format("select-run {}\nrun 2\nexpect iteration == {}\n", values_.rows[row][1], values_.number(row, "later_iteration"));
      script += near("minimum", values_.number(row, "later_minimum")) + near("mean", values_.number(row, "later_mean"));
    }
    return script;
  }
  [[nodiscard]] nlohmann::json json(const std::string& file) const { return nlohmann::json::parse(read_file(path(file)), nullptr, false); }

 private:
  static std::string near(const std::string& quality, double value) {
    constexpr double kLastDigits = 1e-12;
    return fmt::format("expect {0} >= {1}\nexpect {0} <= {2}\n", quality, value - kLastDigits, value + kLastDigits);
  }

  Table values_ = read_table(path("values.csv"));
};

TEST_F(SessionsOfBefore, OpenWhereTheyStoodAndGoOnAsTheyDid) {
  ASSERT_EQ(names().size(), 10U);
  for (const std::string& name : names())
    done({"script", "-"}, fmt::format("open-state {}\n", path(name + ".json")) + look(name) + go_on(name));
}

TEST_F(SessionsOfBefore, AreSavedAsTheyWereAndOpenAgain) {
  for (const std::string& name : names()) {
    SCOPED_TRACE(name);
    done({"script", "-"}, fmt::format("open-state {}\nsave-state {}\n", path(name + ".json"), path("again.json")));
    const nlohmann::json before = json(name + ".json"), now = json("again.json");
    for (const char* key : {"active", "shown"}) EXPECT_EQ(now.value(key, nlohmann::json()), before.value(key, nlohmann::json())) << key;
    ASSERT_EQ(now["runs"].size(), before["runs"].size());
    for (std::size_t k = 0; k < now["runs"].size(); ++k) {
      const nlohmann::json &was = before["runs"][k], &is = now["runs"][k];
      for (const char* key : {"moment", "edits", "positions"})
        EXPECT_EQ(is.value(key, nlohmann::json()), was.value(key, nlohmann::json())) << key;
      for (const auto& [key, value] : was["parameters"].items()) EXPECT_EQ(is["parameters"].value(key, nlohmann::json()), value) << key;
    }
    done({"script", "-"}, fmt::format("open-state {}\n", path("again.json")) + look(name));
  }
}

TEST_F(SessionsOfBefore, WithoutAParameterHaveWhatWasUsualThen) {
  done({"script", "-"}, fmt::format("open-state {}\nsave-state {}\n", path("older.json"), path("again.json")));
  const nlohmann::json parameters = json("again.json")["runs"][0]["parameters"];
  EXPECT_EQ(parameters["relaxation"], 1.0);
  EXPECT_EQ(parameters["directions"], "random");
  EXPECT_EQ(parameters["seed"], 1);
  EXPECT_EQ(parameters["interfaces"], "free");
}

TEST_F(FilesOfBefore, ACheckpointGoesOnToTheSameBits) {
  done({"smooth",       path("grid.off"),
        "-o",           path("out.off"),
        "--grid",       "6",
        "--levels",     "2",
        "--omega",      "0.9",
        "--order",      "shuffle:5",
        "--fix",        "27-29",
        "--then",       "arithmetic-mean",
        "--iterations", "9",
        "--guard",      "off",
        "--layers",     "free",
        "--resume",     path("checkpoint.json")});  // usual in that version
  EXPECT_TRUE(read_file(path("out.off")) == read_file(path("resumed.off")));
}

TEST_F(FilesOfBefore, CommandsOfASessionRun) { done({"script", path("commands.txt")}); }

TEST_F(FilesOfBefore, CommandsOfTheWindowRun) {
  const nlohmann::json opengl = json_of(run({"info", "--json"}))["opengl"];
  if (!opengl["usable"].get<bool>()) GTEST_SKIP() << opengl["description"];
  done({"script", path("window.txt"), "--headless"});
}

TEST_F(FilesOfBefore, CommandLinesRun) {
  for (const std::string& line : lines_of(read_file(path("command_lines.txt"))))
    if (const std::vector<std::string> words = split_words(line); !words.empty()) done(words);
}

}  // namespace
}  // namespace dmoscope::test
