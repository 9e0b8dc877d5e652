// The hold of a run's minimum in a session: by its command, anew for each moment, and found by the engine at rest.

#include <gmock/gmock.h>

#include "core/engine/engine.h"
#include "tests/session/spoken_session.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using ::testing::HasSubstr;

class HoldsTest : public testing::SpokenSession {};

TEST_F(HoldsTest, OfEachMomentOnce) {
  session_.open(testing::lattice(8, 0.3, 3), progress_);
  EXPECT_FALSE(session_.holds().of(session_, 0).found);
  const auto first = session_.holds().find(session_, 0, progress_);
  ASSERT_TRUE(first);
  EXPECT_EQ(session_.holds().find(session_, 0, progress_), first) << "known already";
  EXPECT_TRUE(session_.holds().of(session_, 0).now);
  (void)session_.active().step(StepUnit::Iteration, progress_);
  EXPECT_EQ(session_.holds().of(session_, 0).found, first);
  EXPECT_FALSE(session_.holds().of(session_, 0).now) << "of the moment before";
  EXPECT_NE(session_.holds().find(session_, 0, progress_), first);
  EXPECT_TRUE(session_.holds().of(session_, 0).now);
}

TEST(HoldsOfAnEngine, AreThereOnceItRests) {
  Engine engine(1);
  engine.post("generate coast 400");
  engine.post("step iteration 3");
  engine.wait_idle();
  const auto view = engine.view();
  const auto& held = view->runs[0].held;
  ASSERT_TRUE(held.found);
  EXPECT_TRUE(held.now);
  EXPECT_DOUBLE_EQ(held.found->quality, engine.view()->frame->statistics.minimum);
  (void)engine.take_messages();
  engine.post("held-by");
  engine.wait_idle();
  const auto said = engine.take_messages();
  ASSERT_FALSE(said.empty());
  EXPECT_EQ(said.back().text, held.found->sentence());
}

}  // namespace
}  // namespace dmoscope
