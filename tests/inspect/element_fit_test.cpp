// Deviation and tilt of elements: against plain geometry on a roof, and against the bound after real runs.

#include "core/inspect/element_fit.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/run/run.h"
#include "tests/support/meshes.h"
#include "tests/support/plain_surface.h"
#include "tests/support/volume_grids.h"

namespace dmoscope {
namespace {

using testing::input;

constexpr double kHigh = 0.1;  // height of a roof over x = 0 to 2, with its ridge at x = 1
double roof(double x) { return kHigh * (1.0 - std::abs(x - 1.0)); }
StandingRule all_slide() {
  StandingRule rule;
  rule.boundary = BoundaryRule::Slide;
  rule.corner_angle = 80.0;
  return rule;
}

TEST(ElementFit, OfAnEdgeAcrossACornerOfAPolyline) {
  Mesh mesh;
  for (const double x : {0.0, 1.0, 2.0}) mesh.positions.push_back({x, roof(x), 0});
  for (const double x : {0.0, 1.0, 2.0}) mesh.positions.push_back({x, 1, 0});
  for (const double x : {0.0, 1.0, 2.0}) mesh.positions.push_back({x, 2, 0});
  for (const double x : {0.0, 1.0, 2.0}) mesh.positions.push_back({x, 3, 0});
  for (Index j = 0; j < 3; ++j)
    for (Index i = 0; i < 2; ++i) testing::add(mesh, {3 * j + i, 3 * j + i + 1, 3 * j + i + 4, 3 * j + i + 3});
  const auto all = input(std::move(mesh));
  const Domain domain(*all, all_slide());
  std::vector<Vec3> positions = all->mesh.positions;
  EXPECT_EQ(element_fit(*all, domain, positions).deviation[0], 0.0F);
  positions[1] = {1.5, roof(1.5), 0};
  const ElementFit fit = element_fit(*all, domain, positions);
  EXPECT_NEAR(fit.deviation[0], testing::distance_to_segment({1, kHigh, 0}, {0, 0, 0}, positions[1]), 1e-7);
  EXPECT_NEAR(fit.deviation[1], 0.0, 1e-7) << "its edge lies on the input's";
  EXPECT_EQ(fit.deviation[2], 0.0F);
  EXPECT_TRUE(fit.tilt.empty());
}

TEST(ElementFit, OfFacesAcrossARidge) {
  for (const bool triangles : {true, false}) {
    Mesh mesh;
    for (Index j = 0; j < 3; ++j)
      for (const double x : {0.0, 1.0, 2.0}) mesh.positions.push_back({x, static_cast<double>(j), roof(x)});
    for (const Index a : {Index{0}, Index{1}, Index{3}, Index{4}}) {
      if (!triangles) testing::add(mesh, {a, a + 1, a + 4, a + 3});
      if (triangles) testing::add(mesh, {a, a + 1, a + 4}), testing::add(mesh, {a, a + 4, a + 3});
    }
    const auto all = input(std::move(mesh));
    const Domain domain(*all, {});
    ASSERT_TRUE(domain.on_surface(4));
    std::vector<Vec3> positions = all->mesh.positions;
    positions[4] = {1.5, 1.1, roof(1.5)};
    const ElementFit fit = element_fit(*all, domain, positions);
    const auto split = [&](Index e) {
      const auto c = all->mesh.elements.corners(e);
      return testing::triangles_of({{c.begin(), c.end()}}, positions);
    };
    for (Index e = 0; e < fit.deviation.size(); ++e) {
      double most = 0.0, tilt = 0.0;
      for (const auto& [a, b, c] : split(e)) {
        const Vec3 normal = testing::unit(cross(positions[b] - positions[a], positions[c] - positions[a]));
        constexpr int kSamples = 60;
        for (int i = 0; i <= kSamples; ++i) {
          for (int j = 0; i + j <= kSamples; ++j) {
            const double u = static_cast<double>(i) / kSamples, v = static_cast<double>(j) / kSamples;
            const Vec3 p = positions[a] + u * (positions[b] - positions[a]) + v * (positions[c] - positions[a]);
            for (const double side : {1.0, -1.0}) {  // rising before the ridge, falling behind it
              const double base = side > 0 ? 0.0 : 2.0 * kHigh;
              const double t = (base + side * kHigh * p.x - p.z) / (normal.z - side * kHigh * normal.x);
              const double x = p.x + t * normal.x;
              if (side > 0 ? x > 1.0 : x < 1.0) continue;
              most = std::max(most, std::abs(t));
              if (side > 0 ? x > 0.99 : x < 1.01) continue;  // skips elements with a point alone beneath
              const Vec3 beneath = testing::unit({-side * kHigh, 0, 1});
              tilt = std::max(tilt, std::acos(std::min(1.0, std::abs(dot(normal, beneath)))) * 180 / 3.14159265358979);
            }
          }
        }
      }
      EXPECT_GE(fit.deviation[e], most - 1e-6) << e;
      EXPECT_LE(fit.deviation[e], 1.08 * most + 1e-6) << e;
      EXPECT_NEAR(fit.tilt[e], tilt, 1e-3) << e;
    }
  }
}

Vec3 cylinder(Vec3 p) {
  const Vec3 q{2 * p.x - 1, 2 * p.y - 1, 0};
  const double most = std::max(std::abs(q.x), std::abs(q.y)), size = length(q);
  return size > 0.0 ? Vec3{most / size * q.x, most / size * q.y, 3 * p.z} : Vec3{0, 0, 3 * p.z};
}

TEST(ElementFit, OfAVolumeWithinTheBoundAndAboveWhatSamplesFind) {
  Mesh mesh = test::volume_grid(6, test::Fill::Tetrahedra, 0.3, 7);
  for (Vec3& p : mesh.positions) p = cylinder(p);
  const auto all = input(std::move(mesh));
  RunParameters parameters;
  parameters.boundary = BoundaryRule::Slide;
  parameters.max_deviation = 5e-3;
  auto pool = std::make_shared<ThreadPool>(2);
  dmoscope::Run run(all, parameters, pool, 0);
  Progress progress;
  run.iterate(6, progress);
  const std::vector<Vec3> positions(run.positions().begin(), run.positions().end());
  const ElementFit fit = element_fit(*all, *run.domain(), positions, pool.get());
  const ElementFit alone = element_fit(*all, *run.domain(), positions);
  std::vector<std::uint8_t> outside(all->mesh.elements.size(), 0);
  for (const ElementFace& face : all->faces.boundary()) outside[face.element] = 1;
  const auto before = testing::triangles_of(testing::boundary_faces(all->mesh), all->mesh.positions);
  float most = 0.0F;
  for (Index e = 0; e < outside.size(); ++e) {
    ASSERT_EQ(std::isnan(fit.deviation[e]), outside[e] == 0) << e;
    ASSERT_EQ(std::isnan(fit.tilt[e]), outside[e] == 0) << e;
    if (outside[e] == 0) continue;
    EXPECT_EQ(fit.deviation[e], alone.deviation[e]) << "the same for any pool";
    most = std::max(most, fit.deviation[e]);
    EXPECT_LE(fit.tilt[e], 60.001F);
    std::vector<testing::Triangle> own;
    for (const ElementFace& face : all->faces.boundary()) {
      const auto c = vertices_of(all->mesh.elements, face);
      if (face.element == e) own.push_back({c[0], c[1], c[2]});
    }
    EXPECT_LE(testing::deviation(positions, own, all->mesh.positions, before), fit.deviation[e] + 1e-6) << e;
  }
  EXPECT_GT(most, 0.0F);
  EXPECT_LE(most, parameters.max_deviation * all->geometry.size * (1 + 1e-6));
}

/// Two blocks with a sliding interface: elements on either side have its values, and none on the boundary.
TEST(ElementFit, OfAnInterfaceOnBothSides) {
  Mesh mesh = test::volume_grid(4, test::Fill::Hexahedra, 0.2, 3);
  for (const bool upper : {false, true}) {
    Group group;
    group.name = upper ? "upper" : "lower";
    group.dimension = 2;  // dimension of elements
    for (Index e = 0; e < mesh.elements.size(); ++e)
      if ((e >= mesh.elements.size() / 2) == upper) group.members.push_back(e);
    mesh.groups.push_back(std::move(group));
  }
  const auto all = input(std::move(mesh));
  StandingRule rule;
  rule.interfaces = InterfaceRule::Slide;
  const Domain domain(*all, rule);
  const ElementFit fit = element_fit(*all, domain, all->mesh.positions);
  for (Index e = 0; e < fit.deviation.size(); ++e) {
    const Index layer = e / 16;
    EXPECT_EQ(std::isnan(fit.deviation[e]), layer == 0 || layer == 3) << e;
    EXPECT_FALSE(fit.deviation[e] != 0.0F && !std::isnan(fit.deviation[e])) << e;
  }
}

}  // namespace
}  // namespace dmoscope
