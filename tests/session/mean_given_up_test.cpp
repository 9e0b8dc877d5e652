// The cost of max-min for the mean is reported, and the report holds.

#include <algorithm>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "core/base/number_text.h"
#include "core/run/ending.h"
#include "tests/session/spoken_session.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

class MeanGivenUp : public testing::SpokenSession {
 protected:
  std::string told() {
    const dmoscope::Run& run = session_.active();
    return mean_given_up(run.parameters(), run.history().records(), run.moment().iteration);
  }
};

TEST_F(MeanGivenUp, IsToldWithWhatTheMeanWasAndIs) {
  say("generate random 400");  // its boundary has thin triangles: the others follow them
  say("until-converged best");
  const dmoscope::Run& run = session_.active();
  const auto& records = run.history().records();
  const auto best = std::ranges::max_element(records, {}, [](const IterationRecord& r) { return r.statistics.mean; });
  const Statistics& here = records[run.moment().iteration].statistics;
  ASSERT_GT(best->statistics.mean, here.mean + 0.005) << "else this test shows nothing";
  const std::string fell = told();
  EXPECT_THAT(fell, HasSubstr(fmt::format("from {:.3f} (", best->statistics.mean)));
  EXPECT_THAT(fell, HasSubstr(fmt::format("to {:.3f} ", here.mean)));
  EXPECT_THAT(fell, HasSubstr(best == records.begin() ? "(the input)" : fmt::format("(iteration {})", best - records.begin())));

  // A second phase raises the mean and keeps the minimum, as reported.
  const Statistics before = run.statistics();
  say("then mean");
  say("until-converged best");
  EXPECT_GT(session_.active().statistics().mean, before.mean + 0.005);
  EXPECT_GE(session_.active().statistics().minimum, before.minimum);
  EXPECT_THAT(told(), IsEmpty());
}

TEST_F(MeanGivenUp, IsNotToldWhereTheMeanRoseOrAnElementIsInverted) {
  session_.open(testing::lattice(10, 0.2, 71), progress_);
  say("until-converged best");
  EXPECT_THAT(told(), IsEmpty());
  Mesh tangled = testing::lattice(10, 0.2, 71);
  tangled.positions[0] = {0.5, 0.5, 0};
  session_.open(std::move(tangled), progress_);
  say("run 3");
  ASSERT_GT(session_.active().statistics().inverted, 0U);
  EXPECT_THAT(told(), IsEmpty());
}

TEST_F(MeanGivenUp, MinimumAndMeanAreToldAgainstTheInput) {
  say("generate random 400");
  say("until-converged best");
  const dmoscope::Run& run = session_.active();
  const Statistics &input = run.history().records().front().statistics, now = run.statistics();
  EXPECT_THAT(messages_, ::testing::Contains(fmt::format("minimum {} -> {}, mean {} -> {}", four_digits(input.minimum),
                                                         four_digits(now.minimum), four_digits(input.mean), four_digits(now.mean))));
}

TEST_F(MeanGivenUp, OneCommandRaisesItInARunBeside) {
  say("generate random 400");
  say("until-converged best");
  const Statistics alone = session_.active().statistics();
  say("raise-mean");
  ASSERT_EQ(session_.run_count(), 2U);
  const dmoscope::Run& run = session_.active();
  EXPECT_TRUE(run.parameters().then_mean);
  ASSERT_TRUE(run.mean_since());
  EXPECT_GE(run.statistics().minimum, alone.minimum - 1e-6);
  EXPECT_GT(run.statistics().mean, alone.mean + 0.005);
  say("raise-mean");
  EXPECT_EQ(session_.run_count(), 2U) << "a run that raises it goes on";
  say("undo");
  say("undo");
  EXPECT_EQ(session_.run_count(), 1U);
}

/// A dart with a vertex in its upper part: the mean of its corners lies below, outside.
TEST_F(MeanGivenUp, AMethodThatPromisesNothingIsToldToHaveMadeElementsWorse) {
  Mesh dart;
  dart.positions = {{-4, -4, 0}, {0, 0, 0}, {4, -4, 0}, {0, 2, 0}, {0, 1, 0}};
  for (Index i = 0; i < 4; ++i) testing::add(dart, {i, (i + 1) % 4, 4});
  session_.open(std::move(dart), progress_);
  say("method laplace");
  say("relaxation 0.3");
  const auto worse = [&](std::uint64_t iteration) {
    return made_worse(session_.active().parameters(), session_.active().history().records(), iteration);
  };
  const double before = session_.active().statistics().minimum;
  say("run 1");
  EXPECT_EQ(worse(1), fmt::format("laplace made elements worse: the minimum fell from {} to {}", four_digits(before),
                                  four_digits(session_.active().statistics().minimum)));
  EXPECT_THAT(worse(0), IsEmpty());
  EXPECT_THAT(made_worse({}, session_.active().history().records(), 1), IsEmpty()) << "of dmo";
  say("run 5");
  EXPECT_EQ(worse(6), "laplace made elements worse: 2 are inverted now, 0 before");
}

}  // namespace
}  // namespace dmoscope
