// Longitude and latitude: the map, and the detection of degrees.

#include "core/mesh/geographic.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/same_bits.h"
#include "core/mesh/mesh.h"

namespace dmoscope {
namespace {

Mesh patch(const char* file, const char* title, double west, double south, double side = 1.0) {
  Mesh mesh;
  mesh.name = file;
  mesh.title = title;
  mesh.positions = {{west, south, 0}, {west + side, south, 0}, {west + side, south + side, 0}, {west, south + side, 0}};
  mesh.elements.add(ElementKind::Quadrilateral, std::vector<Index>{0, 1, 2, 3});
  return mesh;
}

/// Mercator's y is the integral of the secant of the latitude.
TEST(Geographic, TheMapIsMercators) {
  double sum = 0.0;
  constexpr int kSteps = 200000;
  for (int i = 0; i < kSteps; ++i) sum += 60.0 / kSteps / std::cos((i + 0.5) * 60.0 / kSteps * std::numbers::pi / 180.0);
  EXPECT_NEAR(mercator(60.0), sum, 1e-7);
  EXPECT_EQ(mercator(0.0), 0.0);
  EXPECT_NEAR(stretch_of_map(mercator(60.0)), 2.0, 1e-14);
  for (double degrees = -89.0; degrees <= 89.0; degrees += 0.37) EXPECT_NEAR(latitude(mercator(degrees)), degrees, 1e-12);
}

TEST(Geographic, AMeshIsTakenForDegreesWhereItSaysSo) {
  EXPECT_EQ(looks_geographic(patch("a.14", "in degrees at 60 N", -5, 60)), Likeness::Said);
  EXPECT_EQ(looks_geographic(patch("a.14", "w25.4.s0b0.bf.ll.grd", -5, 60)), Likeness::Said);
  EXPECT_EQ(looks_geographic(patch("north_lon_lat.2dm", "", 3, 60)), Likeness::Said);
  EXPECT_EQ(looks_geographic(patch("hgrid.ll.14.gz", "", 3, 60)), Likeness::Said);
  EXPECT_EQ(looks_geographic(patch("a.14", "east coast", -75, 35)), Likeness::Range);
  EXPECT_EQ(looks_geographic(patch("a.14", "a unit square", 0, 0)), Likeness::None);
  EXPECT_EQ(looks_geographic(patch("a.14", "lonely hills, latest", 0, 0)), Likeness::None);
  EXPECT_EQ(looks_geographic(patch("a.14", "a basin in metres, 10 degrees warm", -500, 35, 1000)), Likeness::None);
  EXPECT_EQ(looks_geographic(patch("a.vtk", "in degrees", -75, 35)), Likeness::None);
  EXPECT_EQ(looks_geographic(patch("a.14", "to the pole, in degrees", 0, 89.2)), Likeness::None);
  for (const char* word : {"off", "on", "auto"}) EXPECT_EQ(name(parse_geographic(word)), word);
  EXPECT_THROW((void)parse_geographic("yes"), UsageError);
}

TEST(Geographic, WhatHasNotMovedHasTheFilesBits) {
  Mesh mesh = patch("a.14", "degrees", -5.1, 60.3);
  const std::vector<Vec3> before = mesh.positions;
  map_to_mercator(mesh);
  std::vector<Vec3> positions = mesh.positions;
  positions[1].x += 0.1;
  positions[2].y = mercator(61.0);
  const std::vector<Vec3> places = places_in_file(mesh, positions);
  EXPECT_TRUE(same_bits(places[0], before[0]));
  EXPECT_TRUE(same_bits(places[3], before[3]));
  EXPECT_EQ(places[1].x, before[1].x + 0.1);
  EXPECT_TRUE(same_bits(places[1].y, before[1].y)) << "along a parallel";
  EXPECT_NEAR(places[2].y, 61.0, 1e-12);
  EXPECT_NEAR(on_map(mesh, in_file(mesh, positions[2])).y, positions[2].y, 1e-12);
}

}  // namespace
}  // namespace dmoscope
