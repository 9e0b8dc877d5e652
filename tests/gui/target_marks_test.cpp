// Targets over picked elements: the drawn ellipses against the wanted stretch and direction.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/mesh/generate.h"
#include "core/run/parameters.h"
#include "tests/support/meshes.h"
#include "tests/support/volume_grids.h"
#include "ui/overlays/overlay.h"

namespace dmoscope::app {
namespace {

Frame frame_of(Mesh mesh) {
  Frame frame;
  frame.positions = mesh.positions;
  frame.input = testing::input(std::move(mesh));
  return frame;
}

/// The widest outline except for its casing: lengths from the centre, and the direction of the farthest point.
struct Outline {
  double least = HUGE_VAL, most = 0.0;
  Vec3 farthest{};
  Outline(const std::vector<render::OverlayLine>& lines, Vec3 centre) {
    for (const auto& line : lines) {
      if (line.width != 1.6F) continue;
      const Vec3 way = line.from - centre;
      const double length = std::sqrt(dot(way, way));
      least = std::min(least, length);
      if (length > most) most = length, farthest = way;
    }
  }
};

TEST(TargetMarks, AnEllipseHasTheTargetsStretchAndDirection) {
  const Frame frame = frame_of(testing::lattice(4, 0.2, 5));
  const Index element = 12;
  render::Marks marks;
  ui::add_targets(marks, ui::ScenePoints::of(*frame.input), frame, parse_metric("mean-ratio@aspect:3:30"), std::vector<Index>{element});
  Vec3 centre{};
  for (const Index v : frame.input->mesh.elements.corners(element)) centre = centre + (1.0 / 3.0) * frame.positions[v];
  const Outline ellipse(marks.lines, centre);
  EXPECT_NEAR(ellipse.most / ellipse.least, 3.0, 0.02);
  const double angle = std::atan2(ellipse.farthest.y, ellipse.farthest.x) * 180.0 / std::numbers::pi;
  EXPECT_NEAR(std::fmod(angle + 180.0, 180.0), 30.0, 4.0);  // one of 48 corners
}

double volume_of(const Frame& frame, Index element) {
  const auto c = frame.input->mesh.elements.corners(element);
  const Vec3 u = frame.positions[c[1]] - frame.positions[c[0]], v = frame.positions[c[2]] - frame.positions[c[0]],
             w = frame.positions[c[3]] - frame.positions[c[0]];
  return dot(cross(u, v), w) / 6.0;
}

TEST(TargetMarks, AnEllipsoidToo) {
  const Frame frame = frame_of(test::volume_grid(3, test::Fill::Tetrahedra, 0.35, 6));
  Index element = 0;  // the smallest: targets are as large as the mean
  for (Index e = 1; e < frame.element_count(); ++e)
    if (volume_of(frame, e) < volume_of(frame, element)) element = e;
  render::Marks marks;
  ui::add_targets(marks, {}, frame, parse_metric("mean-ratio@aspect:4:3:1:2"), std::vector<Index>{element});
  Vec3 centre{};
  for (const Index v : frame.input->mesh.elements.corners(element)) centre = centre + 0.25 * frame.positions[v];
  const Outline ellipsoid(marks.lines, centre);
  EXPECT_NEAR(ellipsoid.most / ellipsoid.least, 4.0, 0.05);
  const Vec3 along = (1.0 / std::sqrt(14.0)) * Vec3{3.0, 1.0, 2.0};
  EXPECT_NEAR(std::abs(dot(ellipsoid.farthest, along)) / ellipsoid.most, 1.0, 1e-6);
  // The ellipsoid is as large as the element: half axes of 4 a, a and a, whose product is that of the element's own ellipsoid, 0.28^3 times
  // its volume against the ideal one's.
  const double expected = volume_of(frame, element) / (std::numbers::sqrt2 / 12.0);
  EXPECT_NEAR(ellipsoid.most * ellipsoid.least * ellipsoid.least / (0.28 * 0.28 * 0.28), expected, 0.03 * expected);
}

TEST(TargetMarks, ThereAreNoneWithoutATarget) {
  const Frame plane = frame_of(testing::lattice(3, 0.2, 7)), space = frame_of(test::volume_grid(2, test::Fill::Hexahedra, 0.1, 8));
  render::Marks marks;
  for (const char* metric : {"mean-ratio", "formula:lmin/lmax", "mean-ratio@nothing:input", "mean-ratio@field"}) {
    for (const Frame& frame : {plane, space})
      ui::add_targets(marks, ui::ScenePoints::of(*frame.input), frame, parse_metric(metric), std::vector<Index>{0});
  }
  EXPECT_TRUE(marks.lines.empty());
}

}  // namespace
}  // namespace dmoscope::app
