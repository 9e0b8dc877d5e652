// dmoscope quality against values computed apart from the program in 50-digit arithmetic.

#include <array>
#include <cmath>
#include <functional>
#include <sstream>

#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace dmoscope::test {
namespace {

/// Conversion of a column of the exact values to one of our metrics.
struct Correspondence {
  const char* metric;
  const char* column;
  std::function<double(double)> convert = [](double value) { return value; };
  const char* sign = nullptr;  // a column with the sign that this one lacks
};

struct Oracle {
  const char* name;
  bool signed_by_winding;  // the exact triangle values have no sign; ours do in a plane
  std::vector<Correspondence> metrics;
};

std::vector<Correspondence> of_triangles() {
  return {{"mean-ratio", "mean_ratio"},
          {"mean-ratio-area", "mean_ratio"},
          {"radius-ratio", "radius_ratio_2r_over_R"},
          {"min-angle", "min_angle_deg", [](double degrees) { return degrees * 3.0 / 180.0; }},
          {"max-angle", "max_angle_deg", [](double degrees) { return 1.5 * (1.0 - degrees / 180.0); }},
          {"rectangularity", "rect_eq9"}};
}

std::vector<Correspondence> of_quadrilaterals() {
  return {{"mean-ratio", "mr_corner_min"}, {"mean-ratio-area", "mr_area_4A"}, {"scaled-jacobian", "scaled_jac_min"}};
}

std::vector<Correspondence> of_tetrahedra() {
  return {{"mean-ratio", "mean_ratio"},
          {"radius-ratio", "radius_ratio_3r_over_R"},
          {"scaled-jacobian", "scaled_jac"},
          {"min-angle", "min_dihedral_deg", [](double degrees) { return degrees / (std::acos(1.0 / 3.0) * 180.0 / M_PI); }, "mean_ratio"}};
}

std::vector<Correspondence> of_hexahedra() { return {{"mean-ratio", "mr_corner_min"}, {"scaled-jacobian", "scaled_jac_min"}}; }

std::vector<Correspondence> of_wedges_and_pyramids() {
  return {{"mean-ratio", "mean_ratio"}, {"scaled-jacobian", "scaled_jac"}, {"condition", "condition"}};
}

/// Signed area in x and y of every triangle of an oracle file (three points of its own for each, in order).
std::vector<double> areas_in_xy(const std::string& path, std::size_t count) {
  std::istringstream stream(read_file(path));
  for (std::string word; stream >> word && word != "double";) {
  }
  std::vector<double> areas;
  for (std::size_t i = 0; i < count; ++i) {
    std::array<double, 9> p{};
    for (double& c : p) stream >> c;
    areas.push_back((p[3] - p[0]) * (p[7] - p[1]) - (p[4] - p[1]) * (p[6] - p[0]));
  }
  return areas;
}

void PrintTo(const Oracle& oracle, std::ostream* stream) { *stream << oracle.name; }

class OracleTest : public ::testing::TestWithParam<Oracle> {};

TEST_P(OracleTest, AgreesToTwelveDigits) {
  const Oracle& oracle = GetParam();
  const std::string base = std::string(DMOSCOPE_SOURCE_DIR "/tests/data/oracle/") + oracle.name;
  const Folder folder;
  const Output output = run({"quality", base + ".vtk", "--elements", folder / "q.csv"});
  ASSERT_EQ(output.code, 0) << output.err;
  const Table ours = read_table(folder / "q.csv"), exact = read_table(base + ".exact.csv");
  ASSERT_EQ(ours.rows.size(), exact.rows.size());
  std::vector<double> areas(exact.rows.size(), 1.0);
  if (oracle.signed_by_winding) areas = areas_in_xy(base + ".vtk", exact.rows.size());
  for (std::size_t row = 0; row < exact.rows.size(); ++row) {
    for (const Correspondence& c : oracle.metrics) {
      const double sign = std::copysign(1.0, areas[row]) * (c.sign != nullptr ? std::copysign(1.0, exact.number(row, c.sign)) : 1.0);
      const double expected = sign * c.convert(exact.number(row, c.column));
      EXPECT_NEAR(ours.number(row, c.metric), expected, 1e-12 * std::abs(expected) + 1e-15)
          << oracle.name << " element " << row << ' ' << c.metric;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Exact, OracleTest,
                         ::testing::Values(Oracle{"canon_tri", false, of_triangles()}, Oracle{"rand_tri", true, of_triangles()},
                                           Oracle{"rand_tri3d", false, of_triangles()}, Oracle{"canon_quad", false, of_quadrilaterals()},
                                           Oracle{"rand_quad", false, of_quadrilaterals()}, Oracle{"canon_tet", false, of_tetrahedra()},
                                           Oracle{"rand_tet", false, of_tetrahedra()}, Oracle{"canon_hex", false, of_hexahedra()},
                                           Oracle{"canon_hex_twist", false, of_hexahedra()}, Oracle{"rand_hex", false, of_hexahedra()},
                                           Oracle{"solids", false, of_wedges_and_pyramids()}),
                         [](const auto& test) { return std::string(test.param.name); });

/// Condition and aspect ratio, which the exact files lack, against Verdict's inverse values where it has them.
TEST(Oracle, AgreesWithVerdictOnWhatTheExactFilesLack) {
  struct Inverse {
    const char* file;
    const char* metric;
    const char* column;
  };
  for (const Inverse& check : {Inverse{"canon_tet", "condition", "Condition"}, Inverse{"rand_tet", "condition", "Condition"},
                               Inverse{"canon_hex", "condition", "Condition"}, Inverse{"rand_hex", "condition", "Condition"},
                               Inverse{"canon_tet", "aspect-ratio", "AspectRatio"}, Inverse{"rand_tet", "aspect-ratio", "AspectRatio"}}) {
    const std::string base = std::string(DMOSCOPE_SOURCE_DIR "/tests/data/oracle/") + check.file;
    const Folder folder;
    ASSERT_EQ(run({"quality", base + ".vtk", "--elements", folder / "q.csv"}).code, 0);
    const Table ours = read_table(folder / "q.csv"), verdict = read_table(base + ".verdict.csv");
    ASSERT_EQ(ours.rows.size(), verdict.rows.size());
    std::size_t compared = 0;
    for (std::size_t row = 0; row < verdict.rows.size(); ++row) {
      // Verdict's values of inverted elements are cut off and have no sign.
      const double theirs = verdict.number(row, check.column);
      if (!(ours.number(row, "mean-ratio") > 0.0) || !(theirs < 1e10)) continue;
      ++compared;
      EXPECT_NEAR(ours.number(row, check.metric), 1.0 / theirs, 1e-12 / theirs) << check.file << " element " << row << ' ' << check.metric;
    }
    EXPECT_GT(compared, verdict.rows.size() / 3) << check.file;
  }
}

}  // namespace
}  // namespace dmoscope::test
