// dmoscope bench --draw.

#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace dmoscope::test {
namespace {

TEST(BenchDraw, TellsFramesAndTheWayTheyTook) {
  const Output result = run({"bench", "--sizes", "400", "--draw", "3", "--backend", "cpu", "--json"});
  if (result.code == 3 && result.err.find("drawing without a window") != std::string::npos) GTEST_SKIP() << result.err;
  if (cannot_draw(result)) GTEST_SKIP() << result.err;
  ASSERT_EQ(result.code, 0) << result.err;
  const auto drawing = json_of(result)["drawing"];
  ASSERT_EQ(drawing.size(), 1U);
  const auto& row = drawing[0];
  EXPECT_EQ(row["frames"], 3);
  EXPECT_EQ(row["backend"], "cpu");
  EXPECT_EQ(row["path"], "cpu");
  EXPECT_EQ(row["bytes_to_host"], 0);
  EXPECT_EQ(row["vertices"], 400);
  EXPECT_GT(row["frames_per_second"], 0.0);
  const double parts = row["step_ms"].get<double>() + row["publish_ms"].get<double>() + row["draw_ms"].get<double>();
  EXPECT_NEAR(parts * row["frames_per_second"].get<double>(), 1000.0, 1e-6) << "the parts are all there is";
}

TEST(BenchDraw, DrawsNoPlot) { EXPECT_EQ(run({"bench", "--draw", "3", "--plot", "x.svg"}).code, 2); }

}  // namespace
}  // namespace dmoscope::test
