// Detection of meshes that wrap, and the messages about them.

#include "core/mesh/seam.h"

#include <array>
#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/input/input_mesh.h"
#include "core/mesh/generate.h"
#include "tests/mesh/meshes.h"

namespace dmoscope {
namespace {

using test::add;
using test::lattice;
using test::make;
using ::testing::HasSubstr;
using ::testing::Not;

std::shared_ptr<const InputMesh> prepared(Mesh mesh) {
  Progress progress;
  return prepare_input(std::move(mesh), {}, Need::Smoothing, progress);
}

std::string findings(const InputMesh& input) { return fmt::format("{}", fmt::join(input.report.sentences(), "\n")); }

/// Cells of one degree around (180, 0) with a file's longitudes, which count from `west`.
Mesh around_180(Index n, Index every, double west) {
  Mesh mesh = lattice(n, n, every);
  for (Vec3& p : mesh.positions) {
    p = {p.x + west + 360.0 - n / 2.0 - 0.25, p.y - n / 2.0, 0.0};
    if (p.x > west + 360.0) p.x -= 360.0;
  }
  return mesh;
}

TEST(Seam, APieceAcrossItIsWhatItIsUnwrapped) {
  for (const double west : {-180.0, 0.0, -250.0})
    for (const Index every : {1U, 2U, 100U}) {
      Mesh mesh = around_180(8, every, west);
      const auto input = prepared(mesh);
      EXPECT_EQ(input->geometry.plane.period, 360.0);
      EXPECT_NEAR(input->geometry.size, 8.0 * std::sqrt(2.0), 1e-9);
      EXPECT_TRUE(input->report.inverted_elements.empty());
      EXPECT_TRUE(input->report.degenerate_elements.empty());
      EXPECT_EQ(input->report.flipped_elements, 0U);
      const std::size_t crossing = every == 1 ? 8 : every == 2 ? 12 : 16;
      EXPECT_EQ(input->report.seam_elements, crossing);
      const std::string sentence = fmt::format("{} elements cross the meridian of {} degrees and are judged unwrapped", crossing,
                                               west == 0.0      ? 0.0
                                               : west == -180.0 ? 180.0
                                                                : west + 0.75);
      EXPECT_THAT(findings(*input), HasSubstr(sentence));
      EXPECT_EQ(left_out_of_pictures(input->report.seam_elements, input->geometry.plane), "") << "a picture shows it whole";
      for (Index e = 0; e < mesh.elements.size(); ++e)
        EXPECT_NEAR(length(area_vector(input->mesh, e, input->geometry.plane)), mesh.elements.corners(e).size() == 3 ? 1.0 : 2.0, 1e-9);
    }
}

TEST(Seam, ABandIsRecognisedAndPicturesSaySo) {
  Progress progress;
  const auto input = prepared(generate_mesh("globe", 300, 2, progress));
  EXPECT_EQ(input->geometry.plane.period, 360.0);
  EXPECT_EQ(input->report.boundary_loops, 2U);
  EXPECT_TRUE(input->report.inverted_elements.empty());
  const std::string left_out = left_out_of_pictures(input->report.seam_elements, input->geometry.plane);
  EXPECT_EQ(left_out, fmt::format("pictures leave out the {} elements that cross the meridian", input->report.seam_elements));
}

TEST(Seam, WindingsDoNotMatter) {
  for (const bool all : {true, false}) {
    Mesh mesh = around_180(8, 2, -180.0);
    Index turned = 0;
    for (Index e = 0; e < mesh.elements.size(); ++e) {
      if (!all && e % 3 != 0) continue;
      mesh.elements.flip(e);
      ++turned;
    }
    const auto input = prepared(mesh);
    EXPECT_EQ(input->geometry.plane.period, 360.0);
    EXPECT_EQ(input->report.flipped_elements, turned);
    EXPECT_TRUE(input->report.inverted_elements.empty());
  }
}

TEST(Seam, AThrownVertexThereIsInverted) {
  Mesh mesh = around_180(8, 1, -180.0);
  Vec3& p = mesh.positions[4 * 9 + 4];  // the middle
  p = {-178.2, 0.9, 0.0};               // into the cell beyond the one to the upper right
  const auto input = prepared(mesh);
  EXPECT_EQ(input->geometry.plane.period, 360.0);
  EXPECT_FALSE(input->report.inverted_elements.empty());
  EXPECT_LE(input->report.inverted_elements.size(), 4U);
}

TEST(Seam, WhatIsMerelyWideStaysAsItIs) {
  // Metres, or degrees over most of the Earth: one element is huge, and sound as it is.
  Mesh wide = make({{-170, -80, 0}, {170, -80, 0}, {0, -60, 0}, {-170, 80, 0}, {170, 80, 0}, {-60, 80, 0}, {60, 80, 0}},
                   {{0, 1, 2}, {0, 2, 3}, {1, 4, 2}, {2, 5, 3}, {2, 6, 5}, {2, 4, 6}});
  EXPECT_EQ(prepared(wide)->geometry.plane.period, 0.0);
  for (Index e = 0; e < wide.elements.size(); ++e) wide.elements.flip(e);
  EXPECT_EQ(prepared(wide)->geometry.plane.period, 0.0);
  EXPECT_EQ(prepared(make({{-170, -80, 0}, {170, -80, 0}, {0, -60, 0}}, {{0, 1, 2}}))->geometry.plane.period, 0.0);
  // All elements are wide, and wound clockwise: unwrapped they would be counter-clockwise, but still wider than any on the Earth.
  const Mesh coarse = make({{-100, -50, 0}, {100, -50, 0}, {100, 50, 0}, {-100, 50, 0}}, {{0, 2, 1}, {0, 3, 2}});
  EXPECT_EQ(prepared(coarse)->geometry.plane.period, 0.0);
  // No element wider than half the circle.
  Mesh fine = lattice(36, 16, 2);
  for (Vec3& p : fine.positions) p = {10.0 * p.x - 180.0, 10.0 * p.y - 80.0, 0.0};
  EXPECT_EQ(prepared(fine)->geometry.plane.period, 0.0);
  EXPECT_THAT(findings(*prepared(fine)), Not(HasSubstr("meridian")));
  // An error: one vertex with the wrong sign makes some elements wide, of which unwrapping would mend one side and ruin the other.
  fine.positions[8 * 37 + 34].x *= -1.0;
  EXPECT_EQ(prepared(fine)->geometry.plane.period, 0.0);
  EXPECT_FALSE(prepared(fine)->report.inverted_elements.empty());
  // A mesh that wraps, in a plane that is not that of longitude and latitude, or beyond the poles.
  Mesh upright = around_180(8, 1, -180.0);
  for (Vec3& p : upright.positions) p = {p.x, 0.0, p.y};
  EXPECT_EQ(prepared(upright)->geometry.plane.period, 0.0);
  Mesh beyond = around_180(8, 1, -180.0);
  for (Vec3& p : beyond.positions) p.y += 100.0;
  EXPECT_EQ(prepared(beyond)->geometry.plane.period, 0.0);
}

TEST(Seam, DifferencesAreTheShortestOnes) {
  Plane plane;
  plane.period = 360.0;
  plane.west = -180.0;
  for (const auto& [at, origin, way] : {std::array{-179.75, 179.5, 0.75},
                                        {179.5, -179.75, -0.75},
                                        {10.0, -10.0, 20.0},
                                        {90.0, -90.0, 180.0},
                                        {-91.0, 90.0, 179.0},
                                        {359.5, 0.25, -0.75},
                                        {0.25, 359.5, 0.75}}) {
    EXPECT_EQ(plane.difference({at, 2, 0}, {origin, 1, 0}), (Vec3{way, 1, 0})) << at << ' ' << origin;
    EXPECT_EQ(plane.offset({at, 2, 0}, {origin, 1, 0}), (Vec2<double>{way, 1}));
    EXPECT_EQ(Plane{}.difference({at, 2, 0}, {origin, 1, 0}), (Vec3{at - origin, 1, 0}));
  }
  plane.cut = 90.0;
  EXPECT_EQ(plane.place({-180, 5, 0}), (Vec2<double>{180, 5}));
  EXPECT_EQ(plane.place({100, 5, 0}), (Vec2<double>{100, 5}));
}

}  // namespace
}  // namespace dmoscope
