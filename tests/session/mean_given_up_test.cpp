// What max-min costs the mean is said, and what is said holds.

#include "core/run/mean_given_up.h"

#include <algorithm>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/session/spoken_session.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using MeanGivenUp = testing::SpokenSession;

TEST_F(MeanGivenUp, IsToldWithWhatTheMeanWasAndIs) {
  say("generate random 400");  // whose boundary has thin triangles: the rest is drawn after them
  say("until-converged");
  const dmoscope::Run& run = session_.active();
  const auto& records = run.history().records();
  const auto best = std::ranges::max_element(records, {}, [](const IterationRecord& r) { return r.statistics.mean; });
  ASSERT_GT(best->statistics.mean, records.back().statistics.mean + 0.02) << "else this test shows nothing";
  const std::string told = mean_given_up(run);
  EXPECT_THAT(told, HasSubstr(fmt::format("from {:.3f} (", best->statistics.mean)));
  EXPECT_THAT(told, HasSubstr(fmt::format("to {:.3f} ", records.back().statistics.mean)));
  EXPECT_THAT(told, HasSubstr(best == records.begin() ? "(the input)" : fmt::format("(iteration {})", best - records.begin())));

  // And it is true that a second phase raises it and keeps the minimum.
  const Statistics before = run.statistics();
  say("then mean");
  say("until-converged");
  EXPECT_GT(session_.active().statistics().mean, before.mean + 0.02);
  EXPECT_GE(session_.active().statistics().minimum, before.minimum);
  EXPECT_THAT(mean_given_up(session_.active()), IsEmpty());
}

TEST_F(MeanGivenUp, IsNotToldWhereTheMeanRoseOrAnElementIsInverted) {
  session_.open(testing::lattice(10, 0.2, 71), progress_);
  say("until-converged");
  EXPECT_THAT(mean_given_up(session_.active()), IsEmpty());
  Mesh tangled = testing::lattice(10, 0.2, 71);
  tangled.positions[0] = {0.5, 0.5, 0};
  session_.open(std::move(tangled), progress_);
  say("run 3");
  ASSERT_GT(session_.active().statistics().inverted, 0U);
  EXPECT_THAT(mean_given_up(session_.active()), IsEmpty());
}

}  // namespace
}  // namespace dmoscope
