// save-report: the page of `dmoscope compare` about runs of a session.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/markup.h"
#include "tests/cli/program.h"

namespace dmoscope::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(SessionReport, HasTheNumbersOfCompare) {
  const Folder folder;
  const std::string in = folder / "in.off", page_file = folder / "report.html";
  ASSERT_EQ(run({"generate", "annulus", "--size", "300", "-o", in}).code, 0);
  const std::string script = folder.file(
      "s.txt", fmt::format("open \"{}\"\nbackend cpu\nrun 4\ncompare with dmo:min-angle 4\nsave-report \"{}\"\n", in, page_file));
  const Output said = run({"script", script});
  ASSERT_EQ(said.code, 0) << said.err;
  const std::string page = read_file(page_file);
  EXPECT_EQ(markup_fault(page), "");
  const auto compared = json_of(run({"compare", in, "--run", "dmo:mean-ratio", "--run", "dmo:min-angle", "--judge", "mean-ratio",
                                     "--iterations", "4", "--backend", "cpu", "--json"}));
  ASSERT_EQ(compared["runs"].size(), 2U);
  for (const auto& one : compared["runs"])
    for (const char* column : {"min_quality", "mean_quality", "p1", "p5"})
      EXPECT_THAT(page, HasSubstr(fmt::format("\"{}\"", one[column].get<double>()))) << column;
  EXPECT_THAT(page, HasSubstr("runs as they stand in a session"));
  EXPECT_THAT(page, HasSubstr("iterations that are known by mean-ratio"));
  EXPECT_THAT(page, Not(HasSubstr("<dt>command</dt>"))) << "there was none";
}

TEST(SessionReport, ReplacesNoMeshAndNeedsOne) {
  const Folder folder;
  const std::string in = folder / "in.off";
  ASSERT_EQ(run({"generate", "annulus", "--size", "100", "-o", in}).code, 0);
  const std::string before = read_file(in);
  const Output over = run({"script", folder.file("over.txt", fmt::format("open \"{0}\"\nsave-report \"{0}\"\n", in))});
  EXPECT_EQ(over.code, 2);
  EXPECT_THAT(over.err, HasSubstr("overwrit"));
  EXPECT_EQ(read_file(in), before);
  EXPECT_NE(run({"script", folder.file("none.txt", "save-report " + (folder / "r.html") + "\n")}).code, 0);
}

}  // namespace
}  // namespace dmoscope::test
