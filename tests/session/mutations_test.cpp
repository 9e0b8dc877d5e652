// Damaged sessions and random scripts: refused or sound, and never a crash.

#include <random>

#include <gtest/gtest.h>

#include "tests/fuzz/check_session.h"

namespace dmoscope::testing {
namespace {

/// Changes, omits or doubles a few bytes.
std::string mutated(std::string bytes, std::mt19937_64& random) {
  constexpr std::string_view kNasty = "0123456789-+.e\"{}[],: \n\t#\xff";
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  for (std::size_t edits = 1 + below(3); edits > 0 && !bytes.empty(); --edits) {
    const std::size_t at = below(bytes.size());
    switch (below(4)) {
      case 0:
        bytes[at] = kNasty[below(kNasty.size())];
        break;
      case 1:
        bytes.erase(at, 1 + below(6));
        break;
      case 2:
        bytes.insert(at, 1, kNasty[below(kNasty.size())]);
        break;
      default:
        bytes.insert(at, bytes.substr(below(bytes.size()), below(40)));
        break;
    }
  }
  return bytes;
}

TEST(SessionMutations, AreRefusedOrSound) {
  const std::string good = sample_session();
  ASSERT_TRUE(check_session(good));
  std::mt19937_64 random(1);
  int opened = 0;
  constexpr int kMutants = 150;
  for (int i = 0; i < kMutants; ++i) {
    const std::string bytes = mutated(good, random);
    try {
      opened += check_session(bytes) ? 1 : 0;
    } catch (const std::exception& error) {
      FAIL() << "mutant " << i << ": " << error.what() << "\n" << bytes;
    }
  }
  EXPECT_GT(opened, 0) << "nothing but refusing was tested";
  EXPECT_LT(opened, kMutants);
}

TEST(ScriptMutations, AreRefusedOrSound) {
  std::mt19937_64 random(2);
  ASSERT_NO_THROW(check_script(kSampleScript));
  for (int i = 0; i < 60; ++i) {
    const std::string text = mutated(mutated(std::string(kSampleScript), random), random);
    ASSERT_NO_THROW(check_script(text)) << "mutant " << i << "\n" << text;
  }
}

}  // namespace
}  // namespace dmoscope::testing
