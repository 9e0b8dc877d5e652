// Curves of runs, judged by the metrics of others.
#include "core/view/judgements.h"

#include <gtest/gtest.h>

#include "tests/session/spoken_session.h"

namespace dmoscope {
namespace {

class JudgedCourses : public testing::SpokenSession {
 protected:
  void judge() {
    const auto go_on = [] { return true; };
    (void)judgements_.find(session_, go_on);
    (void)judgements_.find_courses(session_, go_on);
  }
  [[nodiscard]] std::vector<JudgedPoint> course(std::size_t run, Metric metric) {
    for (const JudgedBy& by : *judgements_.of(session_, run))
      if (by.metric == metric) return by.course;
    return {};
  }
  void expect_of_its_records(std::size_t run) {
    const auto& records = session_.run(run).history().records();
    const std::vector<JudgedPoint> points = course(run, Metric::MeanRatio);
    ASSERT_EQ(points.size(), judged_iterations(records.size()).size());
    for (const JudgedPoint& point : points) {
      EXPECT_EQ(point.own_mean, records[point.iteration].statistics.mean) << point.iteration;
      EXPECT_EQ(point.own_minimum, records[point.iteration].statistics.minimum) << point.iteration;
    }
  }
  Judgements judgements_;
};

/// Nothing is judged in between, when values of the abandoned path would be forgotten.
TEST_F(JudgedCourses, APathThatIsTakenAnewIsJudgedAnew) {
  say("generate random 400 3");
  say("compare with dmo:min-angle 6");
  judge();
  expect_of_its_records(1);
  const std::vector<JudgedPoint> before = course(1, Metric::MeanRatio);
  say("select-run 2");
  say("seek 2");
  say("visit 100-220");
  say("run 4");
  judge();
  expect_of_its_records(1);
  const std::vector<JudgedPoint> after = course(1, Metric::MeanRatio);
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t k = 0; k < after.size(); ++k) EXPECT_EQ(after[k].minimum == before[k].minimum, k <= 2) << k;
}

}  // namespace
}  // namespace dmoscope
