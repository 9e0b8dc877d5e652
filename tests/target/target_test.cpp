// Target shapes: their words, their effect on elements, and the detection of boundary layers.

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/mesh/generate.h"
#include "core/numeric/small_matrix.h"
#include "core/quality/defined_judge.h"
#include "core/run/parameters.h"
#include "core/target/boundary_layers.h"
#include "tests/support/meshes.h"
#include "tests/support/testing.h"
#include "tests/support/volume_grids.h"

namespace dmoscope::testing {
namespace {

std::shared_ptr<const InputMesh> generated(const std::string& words) {
  Progress progress;
  return generate_input(words, progress);
}

Field field_of(const std::string& name, int components, std::vector<double> values) {
  Field field;
  field.name = name;
  field.components = components;
  field.values = std::move(values);
  return field;
}
Group group_of(const std::string& name, std::vector<Index> members) {
  Group group;
  group.name = name;
  group.dimension = 2;
  group.members = std::move(members);
  return group;
}

std::vector<double> qualities(const InputMesh& mesh, const std::string& metric) {
  std::vector<double> values(mesh.mesh.elements.size());
  element_qualities(mesh.quality_context(), mesh.mesh.positions, parse_metric(metric), nullptr, values);
  return values;
}

TEST(Targets, AreReadAsTheyAreWritten) {
  for (const char* text : {"ideal", "input", "input:3", "field", "field:metric", "field:\"a:b\"", "\"input\":input",
                           "\"a+b: c\":aspect:2:5+x:input", "aspect:4:30", "aspect:2.5:0:1:0", "layers:input", "layers:input:1%",
                           "layers:input:2:7.5%", "wing:aspect:4:30+tail:ideal+input:2", "2:input", "\"a:b\":field:m"}) {
    const Target target = parse_target(text);
    EXPECT_EQ(to_text(target), text);
    EXPECT_EQ(parse_target(to_text(target)), target);
  }
  EXPECT_EQ(parse_target("layers:input").groups[0].shape.tolerance, kKeptTolerance);
  EXPECT_EQ(parse_target("input").others.tolerance, 0.0);
  EXPECT_EQ(parse_target("a:b:input").groups[0].group, "a:b");
  EXPECT_EQ(parse_target("\"field\":input").groups[0].group, "field");
  for (const char* wrong :
       {"", "idea", "input:-1", "input:1.5", "input:x", "layers:input:200%", "layers:input:0.000001%", "aspect", "aspect:4", "aspect:0.5:3",
        "aspect:4:x", "aspect:4:0:0:0", "aspect:4:1:2", "layers:", ":input", "input+input", "layers", "layers:inpt", "aspect:nan:1"})
    EXPECT_THROW((void)parse_target(wrong), UsageError) << wrong;
}

TEST(Targets, ArePartOfAMetricsName) {
  const Metric metric = parse_metric("mean-ratio@layers:input");
  EXPECT_EQ(info(metric).name, "mean-ratio@layers:input");
  EXPECT_EQ(with_target(Metric::MeanRatio, parse_target("layers:input")), metric);
  EXPECT_EQ(with_target(metric, Target{}), Metric::MeanRatio);
  EXPECT_EQ(parse_metric("mean-ratio@ideal"), Metric::MeanRatio);
  EXPECT_EQ(target_of(with_target(metric, parse_target("input"))), parse_target("input"));
  const Metric formula = parse_metric("formula:min(1, lmin/lmax)@input:2");
  EXPECT_EQ(target_of(formula), parse_target("input:2"));
  EXPECT_EQ(target_of(with_target(formula, Target{})), Target{});
  EXPECT_EQ(parse_metric(info(formula).name), formula);
  EXPECT_THROW((void)parse_metric("mean-ratio@"), UsageError);
  EXPECT_THROW((void)parse_metric("mean-rati@input"), UsageError);
}

/// Equal singular values of the aspect have half of a double's digits. Elements equal to their targets are perfect, whatever their shape;
/// and stay so if the whole mesh is turned.
TEST(Targets, ElementsAsTheyWereArePerfect) {
  std::vector<std::shared_ptr<const InputMesh>> meshes{generated("anisotropic 400"), generated("quads 300"),  generated("mixed 300"),
                                                       generated("tetrahedra 200"),  generated("solids 300"), generated("hexahedra 200"),
                                                       generated("can 300")};
  for (const auto& mesh : meshes)
    for (const char* metric : {"mean-ratio", "relative-size", "shape-size", "aspect", "scaled-jacobian", "formula:2*smin/(smin + smax)"}) {
      for (const double quality : qualities(*mesh, fmt::format("{}@input", metric)))
        ASSERT_NEAR(quality, 1.0, 1e-7) << metric << " on " << mesh->mesh.name;
    }
}

TEST(Targets, OfSimplicesAreMeasuredInTheTargetsSpace) {
  // Any metric, for the target element is the ideal one.
  for (const char* words : {"anisotropic 200", "tetrahedra 150"}) {
    const auto mesh = generated(words);
    for (const MetricInfo& entry : metric_table()) {
      if (!entry.defined_for(mesh->mesh.elements.kind(0)) || entry.metric == Metric::Rectangularity) continue;
      for (const double quality : qualities(*mesh, fmt::format("{}@input", entry.name))) ASSERT_NEAR(quality, 1.0, 1e-7) << entry.name;
    }
  }
}

/// By hand: an element that is twice as long as its target along one edge.
TEST(Targets, AStretchedElementIsJudgedAgainstItsTarget) {
  Mesh mesh = lattice(1, 0.0, 1, Cells::Quadrilaterals);
  for (Vec3& p : mesh.positions) p.x *= 10.0;
  const auto flat = input(mesh);
  EXPECT_NEAR(qualities(*flat, "mean-ratio")[0], 2.0 * 10.0 / 101.0, 1e-12);
  EXPECT_NEAR(qualities(*flat, "mean-ratio@aspect:10:0")[0], 1.0, 1e-12);
  EXPECT_NEAR(qualities(*flat, "mean-ratio@aspect:5:0")[0], 2.0 * 2.0 / 5.0, 1e-12);
  EXPECT_NEAR(qualities(*flat, "mean-ratio@aspect:10:90")[0], 2.0 * 100.0 / 10001.0, 1e-12);
  EXPECT_NEAR(qualities(*flat, "aspect@aspect:5:180")[0], 0.5, 1e-12);
  EXPECT_NEAR(qualities(*flat, "relative-size@aspect:5:45")[0], 1.0, 1e-12);
  // A box in space.
  Mesh box = test::volume_grid(1, test::Fill::Hexahedra);
  for (Vec3& p : box.positions) p.z *= 4.0;
  const auto tall = input(box);
  EXPECT_NEAR(qualities(*tall, "mean-ratio@aspect:4:0:0:1")[0], 1.0, 1e-12);
  EXPECT_NEAR(qualities(*tall, "aspect@aspect:2:0:0:7")[0], 0.5, 1e-12);
}

/// Lengths in the metric field: an edge e has the length sqrt(e^T M e), and an element with edges of equal length is perfect.
TEST(Targets, AMetricFieldMeasuresEdges) {
  const auto mesh = generated("anisotropic 300");
  const Field& field = mesh->mesh.fields.at(0);
  const auto values = qualities(*mesh, "formula:lmin/lmax@field");
  for (Index e = 0; e < values.size(); ++e) {
    const auto corners = mesh->mesh.elements.corners(e);
    // The mean of the logarithms, by the definition of the exponential as a series.
    SmallMatrix logs{2, {}};
    for (const Index v : corners) logs = logs + scaled(1.0 / 3.0, apply(metric_tensor(field, v, 2), [](double x) { return std::log(x); }));
    const SmallMatrix m = apply(logs, [](double x) { return std::exp(x); });
    double least = HUGE_VAL, most = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 a = mesh->mesh.positions[corners[i]], b = mesh->mesh.positions[corners[(i + 1) % 3]];
      const double x = b.x - a.x, y = b.y - a.y;
      const double l = std::sqrt(m.at[0][0] * x * x + 2.0 * m.at[0][1] * x * y + m.at[1][1] * y * y);
      least = std::min(least, l), most = std::max(most, l);
    }
    ASSERT_NEAR(values[e], least / most, 1e-9);
  }
  // The generator's cells are squares in the metric before they are jittered, so that elements are of about unit size.
  double sum = 0.0;
  for (const double size : qualities(*mesh, "formula:sqrt(size)@field")) sum += size;
  EXPECT_NEAR(sum / static_cast<double>(values.size()), std::sqrt(2.0 / std::sqrt(3.0)), 0.1);
}

TEST(Targets, AScalarFieldIsASize) {
  Mesh mesh = lattice(4, 0.0, 1, Cells::Quadrilaterals);
  mesh.fields.push_back(field_of("h", 1, std::vector<double>(mesh.positions.size(), 0.125)));
  const auto one = input(mesh);
  for (const double size : qualities(*one, "formula:size@field:h")) EXPECT_NEAR(size, 4.0, 1e-12);
  for (const double shape : qualities(*one, "mean-ratio@field:h")) EXPECT_NEAR(shape, 1.0, 1e-12);
  try {
    require_defined(parse_metric("mean-ratio@field"), *one);
    ADD_FAILURE() << "a size is no tensor";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("It has numbers: field:h takes them for sizes"));
  }
}

TEST(Targets, WhatIsMissingIsNamed) {
  const auto mesh = generated("quads 100");
  const auto reason = [&](const std::string& metric) -> std::string {
    try {
      require_defined(parse_metric(metric), *mesh);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(reason("mean-ratio@field"), HasSubstr("the mesh has no metric field"));
  EXPECT_THAT(reason("mean-ratio@wing:input"), HasSubstr("unknown group of elements 'wing'"));
  EXPECT_THAT(reason("mean-ratio@aspect:2:1:0:0"), HasSubstr("in degrees"));
  EXPECT_THAT(reason("mean-ratio-area@input"), HasSubstr("quadrilaterals that have a target"));
  EXPECT_THAT(reason("formula:field(\"depth\")"), HasSubstr("reads the field 'depth'"));
  EXPECT_THAT(reason("formula:triangle { 1 }"), HasSubstr("quadrilaterals"));
  EXPECT_EQ(reason("mean-ratio@input"), "");
  Mesh flat = lattice(2, 0.0, 1);
  Field bad = field_of("m", 3, {});
  for (std::size_t v = 0; v < flat.positions.size(); ++v) bad.values.insert(bad.values.end(), {1.0, v == 4 ? 2.0 : 0.0, 1.0});
  flat.fields.push_back(bad);
  try {
    require_defined(parse_metric("mean-ratio@field:m"), *input(flat));
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("not positive definite at vertex 4"));
  }
}

TEST(Targets, AveragingTakesOutNoise) {
  // Cells 8 times as long as high, jittered: the mean of many neighbours is near the cell without jitter.
  Mesh mesh = lattice(16, 0.2, 7, Cells::Quadrilaterals);
  for (Vec3& p : mesh.positions) p.x *= 8.0;
  const auto noisy = input(mesh);
  const auto spread = [&](const std::string& target) {
    double sum = 0.0;
    const auto aspects = qualities(*noisy, "aspect@" + target);
    for (const double a : aspects) sum += 1.0 - a;
    return sum / static_cast<double>(aspects.size());
  };
  EXPECT_LT(spread("input"), 1e-9);
  EXPECT_GT(spread("input:5"), 0.05);                        // each differs from its target now ...
  EXPECT_LT(spread("input:5"), 1.3 * spread("aspect:8:0"));  // ... about as much as from the cell without noise
}

/// Logarithms of the stretches of an element and of its neighbours, by hand: quadrilaterals 1, 4 and 1 wide in a row.
TEST(Targets, AveragingIsByTheMeanOfLogarithms) {
  Mesh mesh;
  for (const double y : {0.0, 1.0})
    for (const double x : {0.0, 1.0, 5.0, 6.0}) mesh.positions.push_back({x, y, 0.0});
  for (Index i = 0; i < 3; ++i) add(mesh, {i, i + 1, i + 5, i + 4});
  const auto values = qualities(*input(mesh), "aspect@input:1");
  EXPECT_NEAR(values[0], 0.5, 1e-12);                        // 1 against the mean of 1 and 4: 2
  EXPECT_NEAR(values[1], std::pow(4.0, -2.0 / 3.0), 1e-12);  // 4 against that of 1, 4 and 1
  EXPECT_NEAR(values[2], 0.5, 1e-12);
}

TEST(Targets, ByGroup) {
  Mesh mesh = lattice(6, 0.0, 1, Cells::Quadrilaterals);
  for (Vec3& p : mesh.positions) p.x *= 3.0;
  mesh.groups.push_back(group_of("left", {0, 6, 12, 18, 24, 30}));
  const auto one = input(mesh);
  const auto values = qualities(*one, "mean-ratio@left:input");
  for (Index e = 0; e < values.size(); ++e) EXPECT_NEAR(values[e], e % 6 == 0 ? 1.0 : 0.6, 1e-12);
  const DefinedJudge judge(defined(parse_metric("mean-ratio@left:input")), one->mesh, {one->geometry, {}});
  EXPECT_EQ(judge.targets().facts().with_target, 6U);
  EXPECT_EQ(judge.targets().facts().phrase, "6 elements of left as they were, 30 elements ideal");
}

/// Meaning of the tolerance: an element whose aspect changed by so much counts 0.
TEST(Targets, KeptElementsFallSteeply) {
  Mesh mesh = lattice(2, 0.0, 1, Cells::Quadrilaterals);
  mesh.groups.push_back(group_of("all", {0, 1, 2, 3}));
  const auto one = input(mesh);
  std::vector<Vec3> positions = one->mesh.positions;
  for (Vec3& p : positions) p.x *= 1.05;
  EXPECT_NEAR(element_quality(one->quality_context(), positions, parse_metric("mean-ratio@all:input:5%"), 0), 0.0, 1e-9);
  EXPECT_GT(element_quality(one->quality_context(), positions, parse_metric("mean-ratio@all:input:10%"), 0), 0.7);
}

// --- Boundary layers

/// Rows of quadrilaterals over y = 0 whose heights grow, triangles above.
Mesh layered(Index columns, Index layers, double first_height, double growth, Index triangle_rows) {
  Mesh mesh;
  double y = 0.0, height = first_height;
  std::vector<double> rows{0.0};
  for (Index k = 0; k < layers; ++k, height *= growth) rows.push_back(y += height);
  for (Index k = 0; k < triangle_rows; ++k) rows.push_back(y += 1.0);
  for (const double row : rows)
    for (Index i = 0; i <= columns; ++i) mesh.positions.push_back({static_cast<double>(i), row, 0.0});
  for (Index j = 0; j + 1 < rows.size(); ++j)
    for (Index i = 0; i < columns; ++i) {
      const Index a = j * (columns + 1) + i, b = a + 1, d = a + columns + 1, c = d + 1;
      if (j < layers) {
        add(mesh, {a, b, c, d});
      } else {
        add(mesh, {a, b, c});
        add(mesh, {a, c, d});
      }
    }
  return mesh;
}

TEST(BoundaryLayers, AreFoundFromTheWall) {
  const Mesh mesh = layered(10, 5, 0.01, 2.0, 3);  // the highest layer is 0.16 high, 1 wide
  const BoundaryLayers layers = find_boundary_layers(mesh, classify(mesh));
  EXPECT_EQ(layers.elements.size(), 50U);
  EXPECT_EQ(layers.most, 5);
  EXPECT_EQ(layers.stacks, 10U);
  for (std::size_t i = 0; i < layers.elements.size(); ++i) EXPECT_EQ(layers.heights[i], layers.elements[i] / 10 + 1);
}

TEST(BoundaryLayers, EndWhereElementsAreAsHighAsWide) {
  const Mesh mesh = layered(4, 9, 0.05, 2.0, 1);  // 0.05, 0.1, 0.2, 0.4, 0.8 (1.25 times as wide), 1.6 ...
  EXPECT_EQ(find_boundary_layers(mesh, classify(mesh)).most, 5);
  EXPECT_TRUE(find_boundary_layers(layered(4, 3, 0.6, 1.0, 2), {}).empty()) << "not twice as wide as high";
  EXPECT_TRUE(find_boundary_layers(lattice(5, 0.0, 1), {}).empty()) << "triangles";
}

TEST(BoundaryLayers, EndWhereOneIsMuchFlatterThanTheOneBelow) {
  const Mesh shrinking = layered(4, 3, 0.2, 0.5, 1);  // 0.2, 0.1, 0.05
  EXPECT_EQ(find_boundary_layers(shrinking, classify(shrinking)).most, 1);
  const Mesh slowly = layered(4, 3, 0.2, 0.9, 1);
  EXPECT_EQ(find_boundary_layers(slowly, classify(slowly)).most, 3);
}

TEST(BoundaryLayers, InVolumes) {
  Mesh grid = test::volume_grid(6, test::Fill::Hexahedra);
  for (Vec3& p : grid.positions) p.z = p.z < 0.5 ? 0.02 * p.z : p.z;  // the three lowest layers are flat
  const auto mesh = input(grid);
  const BoundaryLayers layers = find_boundary_layers(mesh->mesh, mesh->geometry);
  for (const Index e : layers.elements) {
    double z = 0.0;
    for (const Index v : mesh->mesh.elements.corners(e)) z = std::max(z, mesh->mesh.positions[v].z);
    EXPECT_LT(z, 0.5) << "element " << e;
  }
  EXPECT_EQ(layers.elements.size(), 6U * 6U * 2U);
}

TEST(SmallMatrices, AreWhatTheyAre) {
  Random random(3);
  for (int n : {2, 3})
    for (int i = 0; i < 500; ++i) {
      SmallMatrix a{n, {}};
      for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c)
          if (static_cast<int>(std::max(r, c)) < n) a.at[r][c] = random(-1.0, 1.0);
      if (std::abs(determinant(a)) < 1e-2) continue;
      if (determinant(a) < 0.0) std::swap(a.at[0], a.at[1]);
      const auto near = [n](const SmallMatrix& x, const SmallMatrix& y, double room) {
        for (std::size_t r = 0; static_cast<int>(r) < n; ++r)
          for (std::size_t c = 0; static_cast<int>(c) < n; ++c) EXPECT_NEAR(x.at[r][c], y.at[r][c], room);
      };
      near(a * inverse(a), SmallMatrix::identity(n), 1e-11);
      const Polar p = polar(a);
      near(p.stretch * p.rotation, a, 1e-11);
      near(p.rotation * transposed(p.rotation), SmallMatrix::identity(n), 1e-8);
      near(p.stretch, transposed(p.stretch), 1e-11);
      const SmallMatrix m = a * transposed(a), u = upper_root(m);
      near(transposed(u) * u, m, 1e-11);
      near(apply(apply(m, [](double x) { return std::log(x); }), [](double x) { return std::exp(x); }), m, 1e-10);
    }
}

}  // namespace
}  // namespace dmoscope::testing
