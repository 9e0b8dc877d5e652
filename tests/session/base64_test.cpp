// Base64 against RFC 4648, and positions packed in it.

#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/session/json_values.h"

namespace dmoscope {
namespace {

TEST(Base64, IsThatOfTheStandard) {
  const auto encode = [](std::string_view text) {
    return to_base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});  // NOLINT
  };
  // RFC 4648, section 10.
  const std::pair<const char*, const char*> known[] = {
      {"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foob", "Zm9vYg=="}, {"fooba", "Zm9vYmE="}, {"foobar", "Zm9vYmFy"}};
  for (const auto& [plain, coded] : known) {
    EXPECT_EQ(encode(plain), coded);
    const auto back = from_base64(coded);
    ASSERT_TRUE(back.has_value());
    EXPECT_EQ(std::string(back->begin(), back->end()), plain);
  }
  for (const char* bad : {"Z", "Zg=", "Z===", "====", "Zg==Zg==", "Zm9\n", "Zm9v    "}) EXPECT_FALSE(from_base64(bad).has_value()) << bad;
  const std::vector<Vec3> positions{{1.0 / 3.0, -0.0, 5e-324}, {1e308, -2.5, 3.0}};
  const auto back = unpack_positions(pack_positions(positions), 2);
  ASSERT_TRUE(back.has_value());
  EXPECT_TRUE(same_bits(*back, positions));
  EXPECT_FALSE(unpack_positions(pack_positions(positions), 3).has_value());
  EXPECT_FALSE(unpack_positions(pack_positions(std::vector<Vec3>{{HUGE_VAL, 0, 0}}), 1).has_value());
}

}  // namespace
}  // namespace dmoscope
