// Words that may be wrong are all answered by one sentence.

#include "core/base/unknown_value.h"

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/clipping/clip_to_text.h"
#include "core/mesh/generate.h"
#include "core/mesh/interfaces.h"
#include "core/numeric/simd.h"
#include "core/quality/metric.h"
#include "core/search/parameters.h"
#include "core/smooth/execution/accelerator.h"
#include "core/smooth/execution/method_table.h"
#include "core/smooth/task.h"

namespace dmoscope {
namespace {

TEST(UnknownValue, IsGuessedWhereOneWordAloneIsClose) {
  const std::array<std::string_view, 5> known{"mean-ratio", "min-angle", "max-angle", "condition", "cut"};
  EXPECT_EQ(closest_word("mean-rato", known), "mean-ratio") << "a letter is missing";
  EXPECT_EQ(closest_word("Mean-Ratio", known), "mean-ratio") << "case";
  EXPECT_EQ(closest_word("condiitonn", known), "condition") << "two letters are swapped, one is too many";
  EXPECT_EQ(closest_word("men-rattio", known), "mean-ratio") << "a letter is missing, another one is too many";
  EXPECT_EQ(closest_word("cat", known), std::nullopt) << "too short to tell: gpu is not meant to be cpu";
  EXPECT_EQ(closest_word("mox-angle", std::array<std::string_view, 2>{"min-angle", "max-angle"}), "max-angle");
  EXPECT_EQ(closest_word("mix-angle", known), std::nullopt) << "two are equally close";
  EXPECT_EQ(closest_word("skewness", known), std::nullopt);
  EXPECT_EQ(closest_word("", known), std::nullopt);
  EXPECT_EQ(closest_word(std::string(100000, 'm'), known), std::nullopt) << "at once";
  EXPECT_EQ(unknown_value("metric", "min-angel", known),
            "unknown metric 'min-angel'; known are mean-ratio, min-angle, max-angle, condition, cut; did you mean min-angle?");
}

TEST(UnknownValue, IsSaidInTheSameWayEverywhere) {
  const std::vector<std::pair<std::string, std::function<void(std::string_view)>>> readers{
      {"metric", [](std::string_view word) { (void)parse_metric(word); }},
      {"method", [](std::string_view word) { (void)method_info(word); }},
      {"backend", [](std::string_view word) { (void)parse_backend(word); }},
      {"SIMD level", [](std::string_view word) { (void)parse_simd_level(word); }},
      {"precision", [](std::string_view word) { (void)parse_precision(word); }},
      {"directions", [](std::string_view word) { (void)parse_directions(word); }},
      {"rule for interfaces", [](std::string_view word) { (void)parse_interface_rule(word); }},
      {"clip mode", [](std::string_view word) { (void)parse_clip_mode(word); }},
      {"sample",
       [](std::string_view word) {
         Progress progress;
         (void)generate_mesh(word, 0, 1, progress);
       }},
  };
  for (const auto& [kind, read] : readers) {
    try {
      read("quux");
      ADD_FAILURE() << kind << " takes anything";
    } catch (const UsageError& error) {
      EXPECT_THAT(error.what(), ::testing::StartsWith("unknown " + kind + " 'quux'; known are "));
      EXPECT_THAT(error.what(), ::testing::Not(::testing::HasSubstr("did you mean")));
    }
  }
}

}  // namespace
}  // namespace dmoscope
