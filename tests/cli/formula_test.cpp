// Formulas and targets on the command line.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace dmoscope::test {
namespace {

using ::testing::HasSubstr;

TEST(Formulas, AreChecked) {
  const Output good = run({"formula", "4*sqrt(3)*area/l2sum"});
  EXPECT_EQ(good.code, 0);
  EXPECT_THAT(good.out, HasSubstr("triangles and quadrilaterals"));
  const Output bad = run({"formula", "4*sqrt(3*area/l2sum"});
  EXPECT_EQ(bad.code, 2);
  EXPECT_THAT(bad.err, HasSubstr("formula, column 20: expected a sign, ',' or ')', not the end"));
  const Output names = run({"formula"});
  for (const char* word : {"inradius", "min_corner(...)", "mean-ratio", "Frobenius"}) EXPECT_THAT(names.out, HasSubstr(word));
  const auto json = json_of(run({"formula", "lmin/lmax", "--json"}));
  EXPECT_EQ(json["name"], "formula:lmin/lmax");
  EXPECT_EQ(json["scale_free"], true);
  EXPECT_FALSE(json["warnings"].empty());
}

TEST(Formulas, AreOptimised) {
  const Folder folder;
  const std::string coast = sample("coast.14");
  const auto built_in = smooth(coast, folder / "a.14", {"--iterations", "3", "--precision", "double"});
  const auto formula =
      smooth(coast, folder / "b.14", {"--iterations", "3", "--precision", "double", "--metric", "formula:4*sqrt(3)*area/l2sum"});
  EXPECT_EQ(formula["metric"], "formula:4*sqrt(3)*area/l2sum");
  EXPECT_NEAR(formula["after"]["minimum"].get<double>(), built_in["after"]["minimum"].get<double>(), 1e-9);
  const Output refused = run({"smooth", coast, "-o", folder / "c.14", "--metric", "formula:4*sqr(3)*area/l2sum"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("column 3: unknown function 'sqr'"));
  EXPECT_FALSE(exists(folder / "c.14"));
  const Output place = run({"smooth", coast, "-o", folder / "c.14", "--metric", "formula:smin/smax + 1e-9*x(p1)", "--then", "joint"});
  EXPECT_EQ(place.code, 2);
  EXPECT_THAT(place.err, HasSubstr("depends on where elements lie"));
  EXPECT_FALSE(exists(folder / "c.14"));
  const auto joint = smooth(coast, folder / "c.14", {"--iterations", "3", "--metric", "formula:4*sqrt(3)*area/l2sum", "--method", "joint"});
  const auto by_metric = smooth(coast, folder / "d.14", {"--iterations", "3", "--method", "joint"});
  EXPECT_NEAR(joint["after"]["minimum"].get<double>(), by_metric["after"]["minimum"].get<double>(), 1e-4);
}

TEST(Formulas, AreCompared) {
  const Folder folder;
  const std::string mesh = folder / "m.vtu";
  ASSERT_EQ(run({"generate", "mixed", "--size", "300", "-o", mesh}).code, 0);
  const Output all = run({"compare", mesh, "--iterations", "2", "--run", "dmo:formula:min(lmin, lmax)/lmax:cpu", "--run",
                          "dmo:mean-ratio@layers:input,then mean", "--run", "laplace", "--judge", "aspect"});
  EXPECT_EQ(all.code, 0) << all.err;
  EXPECT_THAT(all.out, HasSubstr("formula:min(lmin, lmax)/lmax"));
  EXPECT_THAT(all.out, HasSubstr("mean-ratio@layers:input"));
  EXPECT_EQ(run({"compare", mesh, "--iterations", "1", "--every", "metric", "--target", "layers:input"}).code, 0);
}

TEST(Formulas, HaveAColumnOfTheirOwn) {
  const Folder folder;
  const std::string csv = folder / "e.csv";
  ASSERT_EQ(run({"quality", sample("coast.14"), "--metric", "formula:\"a, b\"; min(smin, smax)/smax", "--elements", csv}).code, 0);
  EXPECT_THAT(read_file(csv), HasSubstr("element,kind,\"formula:\"\"a, b\"\"; min(smin, smax)/smax\"\n"));
}

TEST(Targets, OfAMetricFieldBesideTheMesh) {
  const Folder folder;
  const std::string mesh = folder.file("a.mesh",
                                       "MeshVersionFormatted 2\nDimension 2\nVertices 5\n0 0 0\n4 0 0\n4 1 0\n0 1 0\n1.2 0.4 0\n"
                                       "Triangles 4\n1 2 5 0\n2 3 5 0\n3 4 5 0\n4 1 5 0\nEnd\n");
  const std::string sol = "MeshVersionFormatted 2\nDimension 2\nSolAtVertices 5\n1 3\n";
  std::string values;
  for (int v = 0; v < 5; ++v) values += "0.0625 0 1\n";  // four times as long as high
  (void)folder.file("a.sol", sol + values + "End\n");
  const auto judged = json_of(run({"quality", mesh, "--target", "field", "--json"}));
  const auto smoothed = smooth(mesh, folder / "b.mesh", {"--target", "field", "--iterations", "30"});
  EXPECT_EQ(smoothed["metric"], "mean-ratio@field");
  EXPECT_THAT(smoothed["warnings"].dump(), HasSubstr("The fields of a.sol were not written"));
  EXPECT_NEAR(smoothed["before"]["minimum"].get<double>(), judged["metrics"][0]["minimum"].get<double>(), 1e-12);
  // The optimum is the middle of the square in the metric, with four alike elements.
  EXPECT_NEAR(smoothed["after"]["minimum"].get<double>(), std::sqrt(3.0) / 2.0, 1e-3);  // to the resolution of the finest grid
  // Errors in the field do not keep the mesh from being read.
  (void)folder.file("a.sol", sol + "1 2\n");
  const Output cut = run({"quality", mesh, "--target", "field"});
  EXPECT_EQ(cut.code, 2);
  EXPECT_THAT(cut.err, HasSubstr("the fields beside it were not read: "));
  EXPECT_THAT(cut.err, HasSubstr("a.sol:5: "));
  EXPECT_THAT(cut.err, HasSubstr("no metric field"));
  (void)folder.file("a.sol", "MeshVersionFormatted 2\nDimension 2\nSolAtVertices 6\n1 3\n" + values + "0.0625 0 1\nEnd\n");
  const Output more = run({"quality", mesh});
  EXPECT_EQ(more.code, 0);
  EXPECT_THAT(more.err, HasSubstr("a.sol:3: solutions at 6 vertices, but the mesh has 5"));
}

TEST(Targets, KeepBoundaryLayers) {
  const Folder folder;
  const std::string su2 = shared_mesh("mixed2d/su2_NACA64A010_hybrid_inv.su2");
  if (su2.empty()) GTEST_SKIP() << "the shared meshes are not here";
  // The worst element stands on the airfoil, along which it may slide.
  const auto kept = smooth(su2, folder / "a.su2", {"--target", "layers:input", "--iterations", "20", "--boundary", "slide"});
  EXPECT_GT(kept["after"]["movable_minimum"].get<double>(), 1.3 * kept["before"]["movable_minimum"].get<double>());
  const Output info = run({"info", su2});
  EXPECT_THAT(info.out, HasSubstr("boundary layers"));
}

}  // namespace
}  // namespace dmoscope::test
