// The tokenizer by itself: lines, comments, numbers, counts.

#include "core/io/reading/tokenizer.h"

#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "core/mesh/random.h"

namespace dmoscope {
namespace {

class TokenizerTest : public testing::Test {
 protected:
  Tokenizer over(std::string_view text, TextSyntax syntax = {}) { return {text, "file", syntax, progress_}; }
  double number(std::string_view text) { return over(text).read_double("x"); }
  /// The error of reading a double, "" if none.
  std::string complaint(std::string_view text) {
    try {
      (void)number(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  Progress progress_;
};

TEST_F(TokenizerTest, CountsLinesWhateverTheirEnd) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const std::string text = "a b" + end + end + "c" + end + "d";
    Tokenizer tokens = over(text);
    EXPECT_EQ(tokens.token(), "a");
    EXPECT_EQ(tokens.token(), "b");
    EXPECT_EQ(tokens.line(), 1U);
    EXPECT_EQ(tokens.token(), "c");
    EXPECT_EQ(tokens.line(), 3U);
    EXPECT_EQ(tokens.token(), "d");
    EXPECT_EQ(tokens.line(), 4U);
    EXPECT_TRUE(tokens.at_end());
    EXPECT_EQ(tokens.line_at(text.size() - 1), 4U);
  }
}

TEST_F(TokenizerTest, KeepsToTheLineUnlessFreeForm) {
  Tokenizer tokens = over("1 2\n3");
  (void)tokens.read_double("x");
  (void)tokens.read_double("y");
  EXPECT_FALSE(tokens.more_on_line());
  EXPECT_THROW((void)tokens.read_double("z"), InputError);
  Tokenizer free = over("1 2\n3", {.free_form = true});
  EXPECT_EQ(free.read_double("x"), 1.0);
  EXPECT_EQ(free.read_double("y"), 2.0);
  EXPECT_EQ(free.read_double("z"), 3.0);
}

TEST_F(TokenizerTest, CommentsEndTokens) {
  Tokenizer tokens = over("# first\n1# one\n  # none\n2", {.comment = '#'});
  EXPECT_EQ(tokens.token(), "1");
  EXPECT_EQ(tokens.line(), 2U);
  EXPECT_EQ(tokens.token(), "2");
  EXPECT_EQ(tokens.line(), 4U);
}

TEST_F(TokenizerTest, BackslashJoinsLinesOnlyAtTheirEnd) {
  Tokenizer tokens = over("f 1 \\\r\n2 a\\b 3\\\n\nnext", {.backslash_joins_lines = true});
  for (const std::string_view expected : {"f", "1", "2", "a\\b", "3"}) EXPECT_EQ(tokens.token_on_line(), expected);
  EXPECT_FALSE(tokens.more_on_line());
  EXPECT_EQ(tokens.token(), "next");
  EXPECT_EQ(tokens.line(), 4U);
}

TEST_F(TokenizerTest, RestOfLine) {
  Tokenizer tokens = over(" title here \r\nsecond");
  EXPECT_EQ(trimmed(tokens.rest_of_line()), "title here");
  EXPECT_EQ(tokens.line(), 2U);
  EXPECT_EQ(tokens.rest_of_line(), "second");
  EXPECT_EQ(tokens.rest_of_line(), "");
}

TEST_F(TokenizerTest, ReadsTheNearestDouble) {
  for (const char* text : {"0.1", "-0.0", "1e300", "4.9e-324", "2.2250738585072011e-308", "1.7976931348623157e308", "5.", ".5", "1E+2",
                           "123456789012345678901234567890", "0.3333333333333333333333333333333333"}) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(number(text)), std::bit_cast<std::uint64_t>(std::strtod(text, nullptr))) << text;
  }
  EXPECT_EQ(number("+1.5"), 1.5);
  EXPECT_EQ(number("1.5D+3"), 1500.0);
  EXPECT_EQ(number("-2d-1"), -0.2);
  EXPECT_EQ(number("1e-400"), 0.0);
  EXPECT_TRUE(std::signbit(number("-1e-400")));
  EXPECT_EQ(number("0.00001e-320"), 0.0);
}

TEST_F(TokenizerTest, ReadsTheNearestDoubleOfAnyDigits) {
  Random random(7);
  for (int i = 0; i < 20000; ++i) {
    std::string text = random.below(2) == 0 ? "-" : "";
    const std::uint64_t digits = 1 + random.below(22);
    const std::uint64_t point = random.below(digits + 3);  // may be before the first or after the last digit, or nowhere
    for (std::uint64_t d = 0; d < digits; ++d) {
      if (d == point) text += '.';
      text += static_cast<char>('0' + (random.below(4) == 0 ? 0 : random.below(10)));
    }
    if (point == digits) text += '.';
    if (random.below(8) == 0) text.append("e").append(std::to_string(static_cast<int>(random.below(40)) - 20));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(number(text)), std::bit_cast<std::uint64_t>(std::strtod(text.c_str(), nullptr))) << text;
  }
  for (const char* text : {"9007199254740992", "9007199254740993", "900719925474099.3", "9999999999999999999", ".9007199254740991"}) {
    EXPECT_EQ(number(text), std::strtod(text, nullptr)) << text;
  }
}

TEST_F(TokenizerTest, TakesPlainNumbersAndLeavesTheRest) {
  Tokenizer tokens = over(" 1.5 -7 +3 2D1 12345678901234567890 8\\9 4#5", {.comment = '#', .backslash_joins_lines = true});
  double number = 0.0;
  std::int64_t whole = 0;
  std::size_t begin = 0;
  EXPECT_FALSE(tokens.take_integer(whole, begin));
  ASSERT_TRUE(tokens.take_double(number, begin));
  EXPECT_EQ(number, 1.5);
  EXPECT_EQ(begin, 1U);
  ASSERT_TRUE(tokens.take_integer(whole, begin));
  EXPECT_EQ(whole, -7);
  EXPECT_EQ(begin, 5U);
  for (const char* left : {"+3", "2D1"}) {
    EXPECT_FALSE(tokens.take_double(number, begin));
    EXPECT_FALSE(tokens.take_integer(whole, begin));
    EXPECT_EQ(tokens.token(), left);
  }
  EXPECT_FALSE(tokens.take_integer(whole, begin));
  ASSERT_TRUE(tokens.take_double(number, begin));
  EXPECT_EQ(number, 12345678901234567890.0);
  EXPECT_FALSE(tokens.take_double(number, begin));
  EXPECT_EQ(tokens.token(), "8\\9");
  ASSERT_TRUE(tokens.take_double(number, begin));
  EXPECT_EQ(number, 4.0);
  EXPECT_FALSE(tokens.take_double(number, begin)) << "a comment and the end of the file";
}

TEST_F(TokenizerTest, RefusesWhatIsNoFiniteNumber) {
  for (const char* text : {"nan", "-nan", "inf", "-Infinity", "nan(1)", "1e400", "-1e309", "100000e304"}) {
    EXPECT_NE(complaint(text).find("not a finite number"), std::string::npos) << text << ": " << complaint(text);
  }
  for (const char* text : {"abc", "1.0x", "1..2", "--1", "+-1", "0x10", "1e", "e5", "1,5", "+"}) {
    EXPECT_NE(complaint(text).find("expected x, got"), std::string::npos) << text << ": " << complaint(text);
  }
  EXPECT_EQ(complaint(""), "file:1: the file ends where x is expected");
  EXPECT_EQ(complaint(std::string("\x01\xff")), "file:1: expected x, got \"\\x01\\xff\"");
}

TEST_F(TokenizerTest, ChecksIndices) {
  EXPECT_EQ(over("7").read_index("vertex index", 8, "vertices"), 7U);
  EXPECT_EQ(over("8").read_index("vertex index", 8, "vertices", 1), 7U);
  for (const char* text : {"9", "8", "-1", "4294967303"}) {
    try {
      (void)over(text).read_index("vertex index", 8, "vertices");
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_EQ(error.what(), "file:1: vertex index " + std::string(text) + " out of range (the file has 8 vertices)");
    }
  }
  EXPECT_THROW((void)over("99999999999999999999").read_index("vertex index", 8, "vertices"), InputError);
  EXPECT_THROW((void)over("1.0").read_index("vertex index", 8, "vertices"), InputError);
}

TEST_F(TokenizerTest, RefusesCountsThatTheFileCannotHold) {
  EXPECT_EQ(over("2\n1\n1").read_count("number", 2), 2U);
  EXPECT_THROW((void)over("3\n1\n1").read_count("number", 2), InputError);
  EXPECT_THROW((void)over("-1").read_count("number", 1), InputError);
  EXPECT_THROW((void)over("4294967295").read_count("number", 0), InputError);
  EXPECT_THROW((void)over("9223372036854775807").read_count("number", 8), InputError);
}

TEST_F(TokenizerTest, StopsWhenCancelled) {
  const std::string text(3 << 20, '\n');
  Tokenizer tokens = over(text);
  progress_.request_cancel();
  EXPECT_THROW((void)tokens.token(), Cancelled);
}

}  // namespace
}  // namespace dmoscope
