// Values of formulas for elements, against the built-in metrics and against numbers worked out by hand.

#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <numbers>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/thread_pool.h"
#include "core/formula/evaluator.h"
#include "core/formula/operations.h"
#include "core/mesh/generate.h"
#include "core/numeric/elementary.h"
#include "core/quality/defined_judge.h"
#include "core/quality/formula_values.h"
#include "tests/support/meshes.h"
#include "tests/support/testing.h"

namespace dmoscope::testing {
namespace {

std::shared_ptr<const InputMesh> generated(const std::string& words) {
  Progress progress;
  return generate_input(words, progress);
}

/// Meshes with vertices moved at random: some elements are flat, inverted or sharp.
Mesh thrown(Mesh mesh, double reach, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t v = 0; v < mesh.positions.size(); v += 2) {
    Vec3& p = mesh.positions[v];
    p = p +
        Vec3{random(-reach, reach), random(-reach, reach), mesh.elements.kind(0) >= ElementKind::Tetrahedron ? random(-reach, reach) : 0.0};
  }
  return mesh;
}

std::vector<std::shared_ptr<const InputMesh>> meshes_of_all_kinds() {
  std::vector<std::shared_ptr<const InputMesh>> all;
  for (const Cells cells : {Cells::Triangles, Cells::Quadrilaterals, Cells::Mixed}) {
    all.push_back(input(lattice(12, 0.3, 3, cells), Need::QualityOnly));
    all.push_back(input(lattice(12, 0.9, 4, cells), Need::QualityOnly));
    Mesh stretched = lattice(12, 0.3, 5, cells);
    for (Vec3& p : stretched.positions) p = {1e3 * p.x + 7e5, 1e-2 * p.y - 3.0, 0.0};
    all.push_back(input(std::move(stretched), Need::QualityOnly));
  }
  for (const char* words : {"tetrahedra 300", "hexahedra 300", "solids 400", "tangled-solids 400", "tangled 300"})
    all.push_back(generated(words));
  for (const char* words : {"tetrahedra 200", "hexahedra 200", "solids 300"})
    all.push_back(input(thrown(generated(words)->mesh, 0.3, 8), Need::QualityOnly));
  return all;
}

bool is_defined_for(Metric metric, const InputMesh& mesh) {
  return std::ranges::all_of(mesh.mesh.elements.kinds(), [&](ElementKind kind) { return info(metric).defined_for(kind); });
}

void expect_same_values(Metric metric, const InputMesh& mesh) {
  const Metric formula = parse_metric(fmt::format("formula:{}", formula_of(metric)));
  ASSERT_FALSE(is_built_in(formula));
  std::vector<double> wanted(mesh.mesh.elements.size()), got(wanted.size());
  ThreadPool pool(2);
  element_qualities(mesh.quality_context(), mesh.mesh.positions, metric, nullptr, wanted);
  element_qualities(mesh.quality_context(), mesh.mesh.positions, formula, &pool, got);
  for (Index e = 0; e < wanted.size(); ++e) {
    ASSERT_NEAR(got[e], wanted[e], 1e-12) << info(metric).name << ", element " << e << " of " << mesh.mesh.name << ", a "
                                          << info(mesh.mesh.elements.kind(e)).name;
    ASSERT_EQ(element_quality(mesh.quality_context(), mesh.mesh.positions, formula, e), got[e]) << "one by one";
  }
}

TEST(FormulaValues, AreThoseOfTheBuiltInMetrics) {
  for (const auto& mesh : meshes_of_all_kinds())
    for (const MetricInfo& entry : metric_table())
      if (is_defined_for(entry.metric, *mesh)) expect_same_values(entry.metric, *mesh);
}

TEST(FormulaValues, AreThoseOfTheBuiltInMetricsOnSharedMeshes) {
  const std::filesystem::path folder = std::filesystem::path(DMOSCOPE_SHARED_DIR) / "meshes";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no shared meshes here";
  Progress progress;
  int meshes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || entry.file_size() > 8'000'000) continue;
    std::shared_ptr<const InputMesh> mesh;
    try {
      mesh = load_input(entry.path(), Need::QualityOnly, progress);
    } catch (const Error&) {
      continue;
    }
    if (mesh->is_surface()) continue;  // a formula sees a surface's quadrilaterals in their own plane
    ++meshes;
    for (const MetricInfo& metric : metric_table())
      if (is_defined_for(metric.metric, *mesh)) expect_same_values(metric.metric, *mesh);
  }
  EXPECT_GT(meshes, 10);
}

TEST(FormulaValues, ArePartOfTheTableOfKinds) {
  for (const MetricInfo& entry : metric_table()) {
    KindSet expected = entry.kinds;
    const Metric formula = parse_metric(fmt::format("formula:{}", formula_of(entry.metric)));
    // A condition may hold for more kinds than the metric is meant for: its text is about those alone.
    EXPECT_EQ(info(formula).kinds, expected) << entry.name;
    // Conditions that differ: the ideal triangle is another one; a pyramid's upright corners are beyond the ideal ones; a concave corner is
    // not seen.
    const bool own_ways =
        entry.metric == Metric::Rectangularity || entry.metric == Metric::ScaledJacobian || entry.metric == Metric::MeanRatioArea;
    EXPECT_TRUE(defined(formula).facts.warnings.empty() || own_ways) << entry.name << ": " << defined(formula).facts.warnings.front();
    EXPECT_TRUE(defined(formula).formula->scale_free()) << entry.name << ": " << defined(formula).formula->scale_note();
  }
  for (const NamedFormula& named : named_formulas()) {
    EXPECT_TRUE(defined(parse_metric(named.name)).formula->scale_free()) << named.name;
    if (named.name == "scaled-jacobian-inside") continue;  // a pyramid's upright corners are beyond the ideal ones
    EXPECT_EQ(defined(parse_metric(named.name)).facts.warnings, std::vector<std::string>{}) << named.name;
  }
}

/// Value of a formula for the triangle (1, 1), (5, 1), (1, 4), whose edges are 4, 5 and 3 long, or for another element.
double value_of(const std::string& text, ElementKind kind = ElementKind::Triangle,
                std::vector<Vec3> corners = {{1, 1, 0}, {5, 1, 0}, {1, 4, 0}}) {
  Mesh mesh;
  mesh.positions = corners;
  std::vector<Index> order(corners.size());
  for (Index i = 0; i < order.size(); ++i) order[i] = i;
  mesh.elements.add(kind, order);
  Field depth;
  depth.name = "depth";
  for (std::size_t v = 0; v < corners.size(); ++v) depth.values.push_back(10.0 * static_cast<double>(v));
  mesh.fields.push_back(depth);
  Field material;
  material.name = "material";
  material.on = Field::On::Elements;
  material.values = {7.0};
  mesh.fields.push_back(material);
  const auto one = input(std::move(mesh), Need::QualityOnly);
  return element_quality(one->quality_context(), one->mesh.positions, parse_metric("formula:" + text), 0);
}

TEST(FormulaValues, AreWhatTheNamesSay) {
  using std::numbers::pi;
  const std::pair<const char*, double> kExpected[] = {
      {"area", 6.0},
      {"measure", 6.0},
      {"perimeter", 12.0},
      {"lsum", 12.0},
      {"lmin", 3.0},
      {"lmax", 5.0},
      {"l2sum", 50.0},
      {"l12 + 10*l23 + 100*l31", 354.0},
      {"l13 - l31", 0.0},
      {"amax", pi / 2},
      {"amin", std::atan2(3.0, 4.0)},
      {"inradius", 1.0},
      {"circumradius", 2.5},
      {"x(p2 - p1) + 10*y(p3 - p1)", 34.0},
      {"x(p1) + 10*y(p3)", 41.0},
      {"dot(p2 - p1, p3 - p2)", -16.0},
      {"cross(p2 - p1, p3 - p1)", 12.0},
      {"length((p1 + p2)/2 - p3)", std::hypot(2.0, 3.0)},
      {"length(-p1 + p3)", 3.0},
      {"min_corner(J)", 12.0},
      {"max_corner(length(u))", 5.0},
      {"mean_corner(angle)", pi / 3},
      {"sum_corner(length(u) + length(v))", 24.0},
      {"max_edge(l) - min_edge(l)", 2.0},
      {"sum_edge(dot(e, e))", 50.0},
      {"mean_edge(l)", 4.0},
      {"angle", std::atan2(3.0, 4.0)},  // the least over the corners
      {"det", 12.0 * 2.0 / std::sqrt(3.0)},
      {"norm^2", 50.0 * 2.0 / 3.0},
      {"smax*smin - det", 0.0},
      {"smax^2 + smin^2 - norm^2", 0.0},
      {"field(\"depth\")", 10.0},
      {"field(\"material\")", 7.0},
      {"mean_measure", 6.0},
      {"size", 1.0},
  };
  for (const auto& [text, expected] : kExpected) EXPECT_NEAR(value_of(text), expected, 1e-12) << text;
}

TEST(FormulaValues, AreWhatTheSignsAndFunctionsSay) {
  const std::pair<const char*, double> kExpected[] = {
      {"1 + 2*3 - 4/8", 6.5},
      {"(1 + 2)*3", 9.0},
      {"2^3^2", 512.0},
      {"-2^2", -4.0},
      {"2^-1", 0.5},
      {"--3", 3.0},
      {"1e-3*1000", 1.0},
      {".5 + 1.", 1.5},
      {"7/0", 0.0},
      {"sqrt(-4) + sqrt(9)", 3.0},
      {"cbrt(-8)", -2.0},
      {"4^0.5", 2.0},
      {"8^(2/3)", 4.0},
      {"4^1.5", 8.0},
      {"(-2)^3", -8.0},
      {"2^0.3", std::pow(2.0, 0.3)},
      {"pow(3, 2.5)", std::pow(3.0, 2.5)},
      {"area^area", std::pow(6.0, 6.0)},
      {"abs(-3) + sign(-2) + sign(0)", 2.0},
      {"min(3, 1, 2) + 10*max(3, 1, 2)", 31.0},
      {"clamp(5, 0, 2) + clamp(-5, 0, 2)", 2.0},
      {"exp(1)", std::exp(1.0)},
      {"log(10)", std::log(10.0)},
      {"sin(2) + cos(2) + tan(2)", std::sin(2.0) + std::cos(2.0) + std::tan(2.0)},
      {"asin(0.3) + acos(0.3)", std::numbers::pi / 2},
      {"acos(2) + asin(2)", std::numbers::pi / 2},
      {"atan(0.5) + atan2(-1, -1)", std::atan(0.5) + std::atan2(-1.0, -1.0)},
      {"if(area > 5, 1, 2) + if(area > 5 && area < 6, 10, 20)", 21.0},
      {"if(area >= 6 && !(area != 6) || 1 > 2, 1, 2)", 1.0},
      {"if(area == 6, 3, 4) + if(area <= 5, 10, 20)", 23.0},
      {"a = area/2; b = a*a; b - a", 6.0},
      {"s = size; s*2", 2.0},
      {"a = J; min_corner(a) + max_corner(a)", 24.0},
      {"triangle { 1 } quadrilateral { 2 }", 1.0},
      {"quadrilateral, triangle { 3 }", 3.0},
      {"\"A title\"; 4", 4.0},
      {"min(1,\n  2)\n", 1.0},
      {"a = 2 # two\n# nothing\na*a", 4.0},
      {"length(if(area > 5, p2 - p1, p3 - p1))", 4.0},
  };
  for (const auto& [text, expected] : kExpected) EXPECT_NEAR(value_of(text), expected, 1e-11 * std::max(1.0, std::abs(expected))) << text;
}

TEST(FormulaValues, OfOtherKindsOfElements) {
  const std::vector<Vec3> kBox{{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}, {0, 0, 4}, {2, 0, 4}, {2, 3, 4}, {0, 3, 4}};
  const auto box = [&](const char* text) { return value_of(text, ElementKind::Hexahedron, kBox); };
  EXPECT_NEAR(box("volume"), 24.0, 1e-12);
  EXPECT_NEAR(box("lsum"), 36.0, 1e-12);
  EXPECT_NEAR(box("l17"), std::sqrt(29.0), 1e-12);
  EXPECT_NEAR(box("J"), 24.0, 1e-12);
  EXPECT_NEAR(box("smax + 10*smid + 100*smin"), 4.0 + 30.0 + 200.0, 1e-9);
  EXPECT_NEAR(box("adj^2"), 36.0 + 64.0 + 144.0, 1e-9);
  EXPECT_NEAR(box("max_corner(z(cross(u, v)))"), 6.0, 1e-12);
  const std::vector<Vec3> kTetrahedron{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto tetrahedron = [&](const char* text) { return value_of(text, ElementKind::Tetrahedron, kTetrahedron); };
  EXPECT_NEAR(tetrahedron("volume"), 1.0 / 6.0, 1e-12);
  EXPECT_NEAR(tetrahedron("surface"), 1.5 + 0.5 * std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(tetrahedron("circumradius"), 0.5 * std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(tetrahedron("inradius"), 0.5 / (1.5 + 0.5 * std::sqrt(3.0)), 1e-12);
  EXPECT_NEAR(tetrahedron("amax"), std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(tetrahedron("amin"), std::acos(1.0 / std::sqrt(3.0)), 1e-12);
  EXPECT_NEAR(tetrahedron("max_edge(dihedral) - amax"), 0.0, 1e-12);
  const std::vector<Vec3> kWedge{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 3}, {2, 0, 3}, {0, 2, 3}};
  EXPECT_NEAR(value_of("volume", ElementKind::Wedge, kWedge), 6.0, 1e-12);
  const std::vector<Vec3> kPyramid{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 3}};
  EXPECT_NEAR(value_of("volume", ElementKind::Pyramid, kPyramid), 4.0, 1e-12);
  EXPECT_NEAR(value_of("lmax", ElementKind::Pyramid, kPyramid), std::sqrt(11.0), 1e-12);
  const std::vector<Vec3> kDart{{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}};
  EXPECT_NEAR(value_of("amax", ElementKind::Quadrilateral, kDart),
              2 * std::numbers::pi - 2 * (std::atan2(3.0, -1.0) - std::numbers::pi / 4), 1e-9);
  EXPECT_NEAR(value_of("area", ElementKind::Quadrilateral, kDart), 4.0, 1e-12);
}

TEST(FormulaValues, ElementaryFunctionsAreThoseOfTheLibrary) {
  Random random(5);
  for (int i = 0; i < 20000; ++i) {
    const double x = random(-1.0, 1.0) * std::exp2(random(-40.0, 9.0)), positive = std::exp2(random(-1000.0, 1000.0));
    const auto near = [](double wanted) { return 4e-16 * std::abs(wanted) + 1e-300; };
    EXPECT_NEAR(elementary::exponential(x), std::exp(x), 2.0 * near(std::exp(x)));
    EXPECT_NEAR(elementary::logarithm(positive), std::log(positive), near(std::log(positive)));
    EXPECT_NEAR(elementary::sine(100.0 * x), std::sin(100.0 * x), 3e-16);
    EXPECT_NEAR(elementary::cosine(100.0 * x), std::cos(100.0 * x), 3e-16);
  }
  for (const double x : {0.0, -0.0, 1e308, -1e308, 5e-324, HUGE_VAL, -HUGE_VAL, std::nan("")}) {
    for (const double value : {elementary::exponential(x), elementary::logarithm(x), elementary::sine(x), elementary::cosine(x),
                               elementary::power(x, x), elementary::power(x, 0.5)})
      EXPECT_TRUE(std::isfinite(value) || !std::isfinite(x)) << x;
    EXPECT_TRUE(std::isfinite(elementary::logarithm(x))) << x;
  }
}

TEST(FormulaValues, NamesOfMetricsEndWhereTargetsBegin) {
  EXPECT_EQ(info(parse_metric("formula:lmin/lmax # a @ \"b\n")).name, "formula:lmin/lmax");
  EXPECT_EQ(info(parse_metric("formula:\"a@b\"; lmin/lmax@input")).name, "formula:\"a@b\"; lmin/lmax@input");
  EXPECT_EQ(parse_metric("formula:triangle { area;; }"), parse_metric("formula:triangle { area }"));
  EXPECT_EQ(parse_metric("formula:triangle {\narea\n\n}\n\nquadrilateral { 1 }"),
            parse_metric("formula:triangle { area } quadrilateral { 1 }"));
}

TEST(FormulaValues, PlacesHaveNoMeaningInATargetsSpace) {
  const Formula formula("x(p1)/lmin");
  EXPECT_EQ(formula.kinds(FormulaSpace::Target), 0);
  EXPECT_EQ(formula.kinds(FormulaSpace::Stretched), 0);
  EXPECT_NE(Formula("x(p1 - p2)/lmin").kinds(FormulaSpace::Target), 0);
}

TEST(FormulaValues, AreTheSameInEveryNotation) {
  for (const char* text : {"a=area ; b  = a * 2\n\n b/ a", "triangle{area}quadrilateral {2* area}", "\"T\" ; min( 1 , area )", "-( - area)",
                           "if(area<1||area>2&&!(area==3),1,2)"}) {
    const Formula first(text), again(first.text());
    EXPECT_EQ(again.text(), first.text());
    EXPECT_EQ(value_of(text), value_of(first.text())) << first.text();
    EXPECT_EQ(parse_metric(std::string("formula:") + text), parse_metric("formula:" + first.text()));
  }
}

/// A formula with all operations, on numbers that vary and on constants.
const char* const kEverything =
    "a = J/(1 + l2sum); b = sin(3*a) + cos(a*l12) + exp(a - 1) + log(abs(a) + 0.1) + pow(abs(a) + 0.5, a); "
    "c = atan2(a, b) + cbrt(b) + sqrt(abs(b)); d = if(a < b && b >= c || a == c, min(a, b, c), max(a, b, c)); d + angle + smin/(1 + smax) "
    "+ a/0";

template <class Real>
void expect_same_bits_at_every_level() {
  const Formula formula(kEverything);
  for (const ElementKind kind : {ElementKind::Triangle, ElementKind::Quadrilateral})
    for (Index moving = 0; moving < 3; ++moving) {
      const FormulaProgram& program = formula.program(kind, FormulaSpace::Plain, FormulaUse::Places, moving);
      Random random(9);
      std::vector<Real> uniforms(program.uniforms);
      // Corners about the unit square, so that some of the places give sound elements and some do not.
      constexpr double kSquare[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
      prepare(
          program,
          [&](const FormulaInput& in) {
            const double jitter = random(-0.2, 0.2);
            return in.what == FormulaInput::What::Corner ? kSquare[in.index][in.row] + jitter : 1.0 + jitter;
          },
          uniforms.data());
      std::vector<Real> places(2 * kFormulaBatch);
      for (Real& x : places) x = static_cast<Real>(random(-1.0, 2.0));
      std::vector<std::vector<Real>> results;
      for (const SimdLevel level : supported_simd_levels())
        for (const std::size_t count : {kFormulaBatch, std::size_t{13}, std::size_t{1}}) {
          AlignedNumbers<Real> room;
          Real* registers = room.reserve(program.registers * kFormulaBatch);
          for (const auto& one : program.varying)
            std::copy_n(places.begin() + static_cast<std::ptrdiff_t>(one.input.row * kFormulaBatch), kFormulaBatch,
                        registers + one.at * kFormulaBatch);
          formula_kernel<Real>(level)({program.steps.data(), program.steps.size(), uniforms.data(), program.uniforms, registers, count});
          const FormulaResult<Real> quality(program, uniforms.data(), registers);
          std::vector<Real> values;
          for (std::size_t i = 0; i < count; ++i) values.push_back(quality[i]);
          results.push_back(values);
        }
      for (const auto& one : results) EXPECT_EQ(std::memcmp(one.data(), results[0].data(), one.size() * sizeof(Real)), 0);
      EXPECT_GT(std::set<Real>(results[0].begin(), results[0].end()).size(), kFormulaBatch / 8);
    }
}
TEST(FormulaValues, HaveTheSameBitsAtEverySimdLevel) {
  expect_same_bits_at_every_level<float>();
  expect_same_bits_at_every_level<double>();
}

TEST(FormulaValues, NoPlaceIsAboveTheCeiling) {
  const Formula triangles("2*det/norm^2"), mean("mean_corner(det)");
  EXPECT_FALSE(triangles.program(ElementKind::Triangle, FormulaSpace::Plain, FormulaUse::Places, 0).ceiling);
  EXPECT_FALSE(mean.program(ElementKind::Quadrilateral, FormulaSpace::Plain, FormulaUse::Places, 0).ceiling);
  // The condition depends on the corner that does not touch the moving one.
  constexpr double kCorners[4][2] = {{0.1, -0.2}, {1.2, 0.1}, {0.9, 1.3}, {-0.2, 0.8}};
  for (const auto& [text, most] : {std::pair{"2*det/norm^2", 1.0}, std::pair{"min(0.7, 2*det/norm^2)", 0.7}})
    for (Index moving = 0; moving < 4; ++moving) {
      const Formula formula(text);
      const FormulaProgram& program = formula.program(ElementKind::Quadrilateral, FormulaSpace::Plain, FormulaUse::Places, moving);
      ASSERT_TRUE(program.ceiling) << text;
      std::vector<double> uniforms(program.uniforms);
      prepare(
          program, [&](const FormulaInput& in) { return kCorners[in.index][in.row]; }, uniforms.data());
      const auto *at = kCorners[(moving + 2) % 4], *next = kCorners[(moving + 3) % 4], *last = kCorners[(moving + 1) % 4];
      const Vec2<double> u{next[0] - at[0], next[1] - at[1]}, v{last[0] - at[0], last[1] - at[1]};
      const double untouched = 2.0 * (u.x * v.y - u.y * v.x) / (u.x * u.x + u.y * u.y + v.x * v.x + v.y * v.y);
      EXPECT_NEAR(uniforms[*program.ceiling], std::min(untouched, most), 1e-14) << text << ", corner " << moving;
      Random random(moving + 3);
      AlignedNumbers<double> room;
      double* registers = room.reserve(program.registers * kFormulaBatch);
      for (const auto& one : program.varying)
        for (std::size_t i = 0; i < kFormulaBatch; ++i)
          registers[one.at * kFormulaBatch + i] = kCorners[moving][one.input.row] + random(-0.4, 0.4);
      formula_kernel<double>(SimdLevel::Baseline)(
          {program.steps.data(), program.steps.size(), uniforms.data(), program.uniforms, registers, kFormulaBatch});
      const FormulaResult<double> quality(program, uniforms.data(), registers);
      for (std::size_t i = 0; i < kFormulaBatch; ++i) EXPECT_LE(quality[i], uniforms[*program.ceiling]);
    }
}

TEST(FormulaValues, ByPlacesAreThoseByElements) {
  const auto mesh = input(lattice(6, 0.3, 2, Cells::Mixed));
  for (const char* text : {kEverything, "amin", "2*det/norm^2", "smin/smax", "lmin/lmax", "min(l12, l23)/l31"}) {
    const Formula formula(text);
    for (Index e = 0; e < mesh->mesh.elements.size(); ++e) {
      const auto corners = mesh->mesh.elements.corners(e);
      const ElementKind kind = mesh->mesh.elements.kind(e);
      const auto coordinate = [&](const FormulaInput& in) {
        const Vec3 p = mesh->mesh.positions[corners[in.index]];
        return in.row == 0 ? p.x : p.y;
      };
      FormulaValues whole(formula.program(kind, FormulaSpace::Plain, FormulaUse::Elements, kNoIndex));
      whole.set(0, coordinate);
      whole.run();
      const double expected = whole.quality(0);
      for (Index moving = 0; moving < corners.size(); ++moving) {
        const FormulaProgram& program = formula.program(kind, FormulaSpace::Plain, FormulaUse::Places, moving);
        FormulaValues places(program);
        places.set(0, coordinate);
        places.run();
        EXPECT_NEAR(places.quality(0), expected, 1e-12) << text;
      }
    }
  }
}

TEST(FormulaFacts, SayWhatAFormulaDoesNotKeep) {
  const auto warnings = [](const std::string& text) {
    std::string all;
    for (const std::string& one : defined(parse_metric("formula:" + text)).facts.warnings) all += one + "\n";
    return all;
  };
  EXPECT_EQ(warnings("4*sqrt(3)*area/l2sum").find("triangle"), std::string::npos);
  EXPECT_THAT(warnings("lmin/lmax"), HasSubstr("an inverted triangle has up to"));
  EXPECT_THAT(warnings("2*lmin/lmax"), HasSubstr("the ideal triangle has 2, and should have 1"));
  EXPECT_THAT(warnings("area"), HasSubstr("changes with the mesh's unit of length"));
  EXPECT_THAT(warnings("area + lmin"), HasSubstr("it adds an area and a length (column 6)"));
  EXPECT_THAT(warnings("exp(-area)"), HasSubstr("it takes 'exp' of an area"));
  EXPECT_THAT(warnings("det*0 + x(p1)/lmax"), HasSubstr("depends on where elements lie"));
  EXPECT_THAT(warnings("0*area/l2sum + 1"), HasSubstr("the same for every triangle"));
  EXPECT_THAT(warnings("exp(700)*exp(700) - exp(700)*exp(700) + 0*det"), HasSubstr("have no value"));
  EXPECT_THAT(warnings("exp(lmax)"), HasSubstr("it takes 'exp' of a length (column 1)"));
  EXPECT_TRUE(defined(parse_metric("formula:if(area > 0, lmin/lmax, -1)")).formula->scale_free());
  EXPECT_EQ(info(parse_metric("formula:\"Mine\"; lmin/lmax")).title, "Mine");
}

/// Overflowed values are infinite or no numbers; packs and plain numbers agree on their least and greatest.
template <class Real>
void expect_one_order_of_all_numbers() {
  constexpr Real kInfinity = std::numeric_limits<Real>::infinity(), kNone = std::numeric_limits<Real>::quiet_NaN();
  const std::vector<Real> numbers{kNone, -kInfinity, Real(-1), Real(0), Real(2), kInfinity};
  for (const Operation operation : {Operation::Minimum, Operation::Maximum, Operation::Less, Operation::LessOrEqual, Operation::Select})
    for (const SimdLevel level : supported_simd_levels()) {
      AlignedNumbers<Real> room;
      Real* const registers = room.reserve(3 * kFormulaBatch);
      const std::size_t count = numbers.size() * numbers.size();
      for (std::size_t i = 0; i < count; ++i) {
        registers[i] = numbers[i / numbers.size()];
        registers[kFormulaBatch + i] = numbers[i % numbers.size()];
      }
      const FormulaStep step{operation, 2, 0, 1, 1};
      formula_kernel<Real>(level)({&step, 1, nullptr, 0, registers, count});
      for (std::size_t i = 0; i < count; ++i) {
        const Real a = registers[i], b = registers[kFormulaBatch + i], found = registers[2 * kFormulaBatch + i];
        Real plain{};
        operations::with_operation(operation, [&]<Operation O>() { plain = operations::apply_plain<O>(a, b, b); });
        EXPECT_TRUE(found == plain || (found != found && plain != plain)) << static_cast<int>(operation) << " of " << a << " and " << b;
      }
    }
}
TEST(FormulaValues, OfWhatIsNoNumberAreOneForAllProcessors) {
  expect_one_order_of_all_numbers<float>();
  expect_one_order_of_all_numbers<double>();
}

}  // namespace
}  // namespace dmoscope::testing
