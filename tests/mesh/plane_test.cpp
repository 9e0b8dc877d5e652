#include "core/mesh/plane.h"

#include <gtest/gtest.h>

#include "tests/mesh/meshes.h"

namespace dmoscope {
namespace {

using test::lattice;
using test::make;

void expect_frame(const Plane& p) {
  EXPECT_NEAR(length(p.u), 1, 1e-14);
  EXPECT_NEAR(length(p.v), 1, 1e-14);
  EXPECT_NEAR(dot(p.u, p.v), 0, 1e-14);
  EXPECT_NEAR(length(cross(p.u, p.v) - p.normal), 0, 1e-14);
}

/// The lattice moved into space by p -> origin + x * a + y * b.
Mesh placed(Vec3 origin, Vec3 a, Vec3 b) {
  Mesh mesh = lattice(7, 5, 2);
  for (Vec3& p : mesh.positions) p = origin + p.x * a + p.y * b;
  return mesh;
}

TEST(Plane, EmptyMeshIsPlanarWithZNormal) {
  const Geometry g = classify(Mesh{});
  EXPECT_EQ(g.shape, Shape::Planar);
  EXPECT_EQ(g.plane.normal, (Vec3{0, 0, 1}));
}

TEST(Plane, CoordinatePlanesAreExact) {
  Geometry g = classify(placed({0, 0, 3.7}, {1, 0, 0}, {0, 1, 0}));
  EXPECT_EQ(g.plane.u, (Vec3{1, 0, 0}));
  EXPECT_EQ(g.plane.v, (Vec3{0, 1, 0}));
  EXPECT_EQ(g.deviation, 0);
  EXPECT_DOUBLE_EQ(g.size, std::sqrt(74.0));
  g = classify(placed({-2.1, 0, 0}, {0, 1, 0}, {0, 0, 1}));
  EXPECT_EQ(g.plane.u, (Vec3{0, 1, 0}));
  EXPECT_EQ(g.plane.normal, (Vec3{1, 0, 0}));
  g = classify(placed({0, 0.1, 0}, {1, 0, 0}, {0, 0, 1}));
  EXPECT_EQ(g.plane.u, (Vec3{0, 0, 1}));
  EXPECT_EQ(g.plane.normal, (Vec3{0, 1, 0}));
}

TEST(Plane, TiltedPlaneFarFromTheOrigin) {
  const Vec3 a{0.6, 0.64, 0.48};
  const Vec3 b{-0.8, 0.48, 0.36};
  const Vec3 n = cross(a, b);
  for (const double shift : {0.0, 1e6}) {
    const Geometry g = classify(placed({shift, -shift, shift}, a, b));
    EXPECT_EQ(g.shape, Shape::Planar);
    expect_frame(g.plane);
    EXPECT_NEAR(std::abs(dot(g.plane.normal, n)), 1, 1e-12);
    EXPECT_LT(g.deviation, 1e-8);
    EXPECT_GT(g.plane.normal.z, 0) << "the largest component is positive";
    const Vec3 d = 2.0 * a + -3.0 * b;
    EXPECT_NEAR(length(g.plane.lift(g.plane.project(d)) - d), 0, 1e-9);
  }
}

TEST(Plane, ToleranceIsAMillionthOfTheSize) {
  Mesh mesh = placed({1e6, 1e6, 0}, {1, 0, 0}, {0, 1, 0});
  mesh.positions[20].z = 1e-7;
  EXPECT_EQ(classify(mesh).shape, Shape::Planar);
  mesh.positions[20].z = 1e-3;
  const Geometry g = classify(mesh);
  EXPECT_EQ(g.shape, Shape::Surface);
  EXPECT_EQ(g.plane.normal, (Vec3{0, 0, 1}));
  EXPECT_NEAR(g.deviation, 1e-3, 1e-4);
}

TEST(Plane, UnusedVerticesDoNotCount) {
  Mesh mesh = lattice(3, 3, 1);
  mesh.positions.push_back({500, 500, 500});
  const Geometry g = classify(mesh);
  EXPECT_EQ(g.shape, Shape::Planar);
  EXPECT_DOUBLE_EQ(g.size, std::sqrt(18.0));
}

TEST(Plane, SurfaceTakesThePlaneNearestToTheMeanNormal) {
  // A roof over the (x, z) plane, wound so that its mean normal looks along -y: the plane's normal is still +y.
  const Mesh mesh = make({{0, 0, 0}, {1, 0.3, 0}, {2, 0, 0}, {0, 0, 1}, {1, 0.3, 1}, {2, 0, 1}}, {{0, 1, 4, 3}, {1, 2, 5, 4}});
  const Geometry g = classify(mesh);
  EXPECT_EQ(g.shape, Shape::Surface);
  EXPECT_EQ(g.plane.normal, (Vec3{0, 1, 0}));
}

TEST(Plane, OneVolumeElementMakesAVolume) {
  Mesh mesh = lattice(2, 2, 1);
  mesh.elements.add(ElementKind::Tetrahedron, std::vector<Index>{0, 1, 3, 4});
  EXPECT_EQ(classify(mesh).shape, Shape::Volume);
}

TEST(Plane, OnePointOrOneLineIsPlanar) {
  EXPECT_EQ(classify(make({{1, 2, 3}}, {{0, 0, 0}})).shape, Shape::Planar);
  const Geometry g = classify(make({{0, 0, 0}, {1, 2, 3}, {2, 4, 6}}, {{0, 1, 2}}));
  EXPECT_EQ(g.shape, Shape::Planar);
  expect_frame(g.plane);
}

}  // namespace
}  // namespace dmoscope
