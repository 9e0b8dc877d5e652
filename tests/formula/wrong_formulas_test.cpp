// Errors in formulas are reported with their place and cause.

#include <gtest/gtest.h>

#include "core/formula/formula.h"
#include "tests/support/testing.h"

namespace dmoscope::testing {
namespace {

struct Wrong {
  const char* text;
  std::size_t column;
  const char* cause;  // part of the message
};

const Wrong kWrong[] = {
    // Signs and brackets.
    {"", 1, "expected a number, a name or '(', not the end"},
    {"   ", 4, "not the end"},
    {"+", 2, "expected a number, a name or '('"},
    {"area +", 7, "expected a number, a name or '(', not the end"},
    {"area + * 2", 8, "expected a number, a name or '(', not '*'"},
    {"area 2", 6, "expected a sign between the two, ';', or the end, not the number 2"},
    {"area perimeter", 6, "not the name 'perimeter'"},
    {"2 area", 3, "not the name 'area'"},
    {"2area", 2, "a sign is missing between the number 2 and the letter 'a'"},
    {"(area", 6, "expected a sign or ')', not the end"},
    {"(area))", 7, "this ')' closes nothing"},
    {"area)", 5, "this ')' closes nothing"},
    {")", 1, "expected a number, a name or '(', not ')'"},
    {"()", 2, "expected a number, a name or '(', not ')'"},
    {"min(1, 2", 9, "expected a sign, ',' or ')', not the end"},
    {"min(1 2)", 7, "expected a sign, ',' or ')', not the number 2"},
    {"min(1,)", 7, "expected a number, a name or '(', not ')'"},
    {"min(,1)", 5, "expected a number, a name or '(', not ','"},
    {"1,2", 2, "expected a sign between the two"},
    {"area = ", 8, "expected a number, a name or '(', not the end"},
    {"a = area", 9, "this only names a part"},
    {"a = area;", 10, "expected a number, a name or '(', not the end"},
    {"a = 1; a = 2; a", 8, "'a' has a value already"},
    {"a = 1 b = 2; a", 7, "expected a sign or ';', not the name 'b'"},
    {"1 = 2", 3, "expected a sign between the two"},
    {"area == ", 9, "expected a number, a name or '('"},
    {"area & 2", 6, "'&' alone means nothing: write '&&'"},
    {"area | 2", 6, "'|' alone means nothing: write '||'"},
    {"area @ 2", 6, "'@' means nothing here"},
    {"area ? 1", 6, "'?' means nothing here"},
    {"area[1]", 5, "brackets are round"},
    {"area % 2", 6, "'%' means nothing here"},
    {"area · 2", 6, "'·' means nothing here"},
    {"ärea", 1, "'ä' means nothing here"},
    {"1 + ä", 5, "'ä' means nothing here"},
    {"1..2", 3, "expected a sign between the two"},
    {"1e999", 1, "too large or too small"},
    {"1 < area < 2", 10, "comparisons come one at a time"},
    {"\"title\"", 8, "expected ';' after the title, not the end"},
    {"\"title", 1, "the quotation mark that ends this text is missing"},
    {"\"a\" + 1", 5, "expected ';' after the title, not '+'"},
    {"1 + \"depth\"", 5, "a text is the name of a field"},
    {"{ area }", 1, "expected a number, a name or '(', not '{'"},
    {"area }", 6, "expected a sign between the two, ';', or the end, not '}'"},
    // Kinds.
    {"triangel { area }", 1, "unknown kind of elements 'triangel'"},
    {"triangle { area", 16, "expected '}', not the end"},
    {"triangle { }", 12, "expected a number, a name or '(', not '}'"},
    {"triangle { area } triangle { 1 }", 19, "the triangles have a formula already"},
    {"triangle, triangle { 1 }", 11, "the triangles have a formula already"},
    {"triangle { area } 1", 19, "expected the name of a kind of elements, not the number 1"},
    {"triangle, 2 { area }", 11, "expected the name of a kind of elements"},
    {"triangle { area } quadrilateral", 32, "expected '{', not the end"},
    {"triangle { volume }", 12, "a triangle has an area"},
    {"tetrahedron { area }", 15, "a tetrahedron has a volume"},
    {"triangle { l14 }", 12, "a triangle has only 3 corners"},
    {"triangle { p4 - p1 }", 12, "a triangle has only 3 corners"},
    {"triangle { length(w) }", 19, "a triangle has two edges at a corner"},
    {"quadrilateral { inradius }", 17, "that is of triangles and tetrahedra"},
    {"hexahedron { surface }", 14, "that is of tetrahedra"},
    {"hexahedron { amin }", 14, "those are of tetrahedra"},
    {"triangle { smid }", 12, "two singular values"},
    {"triangle { z(u) }", 12, "have x and y"},
    {"pyramid { p6 }", 11, "a pyramid has only 5 corners"},
    // Names.
    {"aera", 1, "unknown name 'aera'; did you mean area?"},
    {"2*volum", 3, "did you mean volume?"},
    {"foo", 1, "unknown name 'foo'"},
    {"area*foo/2", 6, "unknown name 'foo'"},
    {"a = b; b = 1; a", 5, "'b' has its value only further on"},
    {"a = a; a", 5, "'a' has its value only further on"},
    {"sqrt", 1, "'sqrt' is a function, and its arguments in brackets are missing"},
    {"2*min", 3, "'min' is a function"},
    {"area(2)", 1, "'area' is no function; a '*' before the bracket may be missing"},
    {"p1(2)", 1, "'p1' is no function"},
    {"sqr(2)", 1, "unknown function 'sqr'"},
    {"maximum(1, 2)", 1, "unknown function 'maximum'"},
    {"p9 - p1", 1, "unknown name 'p9'"},
    {"l11", 1, "its ends are one corner"},
    {"l", 1, "'l' is of an edge"},
    {"max(l, 1)", 5, "'l' is of an edge: gather it with min_edge(...)"},
    {"min_corner(l)", 12, "'l' is of an edge"},
    {"min_corner(min_corner(J))", 12, "min_corner inside of another of its kind"},
    {"max_corner(mean_corner(J))", 12, "mean_corner inside of another of its kind"},
    {"min_edge(max_edge(l))", 10, "max_edge inside of another of its kind"},
    // Arguments.
    {"sqrt()", 1, "sqrt(x) takes 1 argument, not 0"},
    {"sqrt(1, 2)", 1, "sqrt(x) takes 1 argument, not 2"},
    {"atan2(1)", 1, "takes 2 arguments, not 1"},
    {"pow(2)", 1, "takes 2 arguments, not 1"},
    {"if(area > 0, 1)", 1, "takes 3 arguments, not 2"},
    {"clamp(1, 2)", 1, "takes 3 arguments, not 2"},
    {"min()", 1, "takes 1 to 64 arguments, not 0"},
    {"field(depth)", 7, "a field is named in quotation marks"},
    {"field(1)", 7, "a field is named in quotation marks"},
    {"field()", 1, "takes 1 argument, not 0"},
    // Numbers, vectors and conditions.
    {"p1", 1, "a metric is a number, and this is a vector"},
    {"area > 0", 6, "a metric is a number, and this is a condition"},
    {"(p1 - p2) + 1", 11, "a vector and a number cannot be added"},
    {"(p2 - p1)*(p3 - p1)", 10, "two vectors are multiplied by dot(a, b) or cross(a, b)"},
    {"1/(p2 - p1)", 2, "nothing is divided by a vector"},
    {"sqrt(p2 - p1)", 9, "a number is needed here, and this is a vector"},
    {"length(area)", 8, "a vector such as p2 - p1 is needed here, and this is a number"},
    {"dot(p2 - p1, 1)", 14, "a vector such as p2 - p1 is needed here"},
    {"if(area, 1, 2)", 4, "a condition such as 'a < b' is needed here, and this is a number"},
    {"!area", 2, "a condition such as 'a < b' is needed here"},
    {"-(area > 0)", 1, "'-' of a condition makes no sense"},
    {"(area > 0) + 1", 12, "conditions are joined with '&&' and '||'"},
    {"if(area > 0 && 1, 1, 2)", 16, "a condition such as 'a < b' is needed here"},
    {"if(area > 0, 1, p1 - p2)", 1, "both must be the same"},
    {"if(p1 - p2 < 1, 1, 2)", 12, "vectors cannot be compared"},
    {"min(area > 0, 1)", 10, "a number is needed here, and this is a condition"},
    {"length(area*p1)", 12, "a place times a number that varies makes no sense"},
    {"length(if(area > 0, p1, p2 - p1))", 8, "between a place and a difference of places"},
};

TEST(WrongFormulas, AreSaidWithTheirColumnAndCause) {
  EXPECT_GE(std::size(kWrong), 100U);
  for (const Wrong& wrong : kWrong) {
    SCOPED_TRACE(wrong.text);
    try {
      const Formula formula(wrong.text);
      ADD_FAILURE() << "it was taken: " << formula.text();
    } catch (const FormulaError& error) {
      EXPECT_EQ(error.place().column, wrong.column) << error.what();
      EXPECT_EQ(error.place().line, 1U);
      EXPECT_NE(std::string(error.what()).find(wrong.cause), std::string::npos) << error.what();
    }
  }
}

TEST(WrongFormulas, HaveTheirLineWhereThereAreSeveral) {
  try {
    const Formula formula("# a comment\na = area\n2*a +* 3");
    ADD_FAILURE();
  } catch (const FormulaError& error) {
    EXPECT_EQ(error.place(), (FormulaPlace{3, 6}));
    EXPECT_STREQ(error.what(), "formula, line 3, column 6: expected a number, a name or '(', not '*'");
  }
}

TEST(WrongFormulas, ThatNobodyWritesEndWithoutHarm) {
  EXPECT_THROW((void)Formula(std::string(100000, '1')), FormulaError);
  EXPECT_THROW((void)Formula(std::string(5000, '(')), FormulaError);
  EXPECT_THROW((void)Formula(std::string(5000, '-') + "1"), FormulaError);
  std::string sum = "area", parts = "a0 = area", doubled = "a0 = area";
  for (int i = 1; i < 3000; ++i) sum += "+area";
  for (int i = 1; i < 1500; ++i) parts += "; a" + std::to_string(i) + " = a" + std::to_string(i - 1) + "+1";
  EXPECT_THROW((void)Formula(sum), FormulaError);
  EXPECT_THROW((void)Formula(parts + "; a1499"), FormulaError);
  // Each part is computed once, or this would take 2^100 steps.
  for (int i = 1; i < 100; ++i) doubled += "; a" + std::to_string(i) + " = a" + std::to_string(i - 1) + "*a" + std::to_string(i - 1);
  EXPECT_NO_THROW((void)Formula(doubled + "; a99"));
  std::string large = "0";
  for (int i = 0; i < 250; ++i)
    large += "+sum_corner(length(u+" + std::to_string(i) + "*v+" + std::to_string(i) + "*w)^" + std::to_string(i + 2) + ")";
  EXPECT_THROW((void)Formula("hexahedron { " + large + " }"), UsageError) << "too many numbers for a program";
}

}  // namespace
}  // namespace dmoscope::testing
