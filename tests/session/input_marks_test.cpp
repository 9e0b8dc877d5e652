// Messages about groups and fields that changed since a session was saved.

#include <vector>

#include <gtest/gtest.h>

#include "core/session/saved_inputs.h"

namespace dmoscope {
namespace {

TEST(InputMarks, SayWhatDiffers) {
  const std::vector<DataMark> then{{"group \"a\"", "1"}, {"group \"b\"", "2"}, {"group \"c\"", "3"}, {"group \"a\"", "4"}};
  EXPECT_EQ(changed_data(then, then), "");
  EXPECT_EQ(changed_data(then, {{"group \"a\"", "4"}, {"group \"c\"", "5"}, {"group \"a\"", "1"}, {"field \"d\"", "6"}}),
            "group \"b\" is gone, group \"c\" has changed, field \"d\" is new");
  EXPECT_EQ(changed_data({}, {{"a", "1"}, {"b", "1"}, {"c", "1"}, {"d", "1"}, {"e", "1"}, {"f", "1"}}),
            "a is new, b is new, c is new, d is new and 2 more");
}

}  // namespace
}  // namespace dmoscope
