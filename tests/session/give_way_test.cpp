// Computing threads give way to drawing ones: checked by the priorities of the threads, on Linux.
#include "core/engine/give_way.h"

#ifdef __linux__

#include <algorithm>
#include <thread>
#include <vector>

#include <gmock/gmock.h>

#include "core/engine/engine.h"
#include "tests/support/nice_values.h"

namespace dmoscope {
namespace {

using ::testing::Each;
using ::testing::SizeIs;

class GiveWay : public ::testing::Test {
 protected:
  void SetUp() override {
    if (testing::own_nice_value() != 0) GTEST_SKIP() << "the tests themselves give way";
  }
  static auto behind() {
    const std::vector<int> all = testing::nice_values();
    return std::ranges::count_if(all, [](int value) { return value > 0; });
  }
};

TEST_F(GiveWay, EveryThreadOfThePoolAndTheCallersGoesBehind) {
  std::vector<int> seen;
  std::thread([&] {
    ThreadPool pool(3);
    give_way(pool);
    seen = testing::nice_values_of(pool);
  }).join();
  EXPECT_THAT(seen, SizeIs(3));
  EXPECT_THAT(seen, Each(::testing::Gt(0)));
  EXPECT_EQ(testing::own_nice_value(), 0) << "this thread has nothing to do with them";
}

TEST_F(GiveWay, AnEngineDoesOnceItSmoothsWhereItWasAskedTo) {
  Engine engine(3);
  const auto after = [&](const char* line) {
    engine.post(line);
    engine.wait_idle();
    return behind();
  };
  EXPECT_EQ(after("generate random 400"), 0);
  EXPECT_EQ(after("run 1"), 0) << "nobody has asked";
  engine.give_way();
  EXPECT_EQ(after("generate random 400"), 0) << "a person waits for a mesh that is opened";
  EXPECT_EQ(after("run 1"), 3);
  EXPECT_EQ(testing::own_nice_value(), 0);
}

}  // namespace
}  // namespace dmoscope

#endif
