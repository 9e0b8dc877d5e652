// Meshes in longitude and latitude with elements across the meridian at which the numbers jump: every method smooths them like unwrapped
// ones.

#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/mesh/generate.h"
#include "core/mesh/nodal_field.h"
#include "core/smooth/execution/method_table.h"
#include "tests/smooth/promises.h"

namespace dmoscope {
namespace {

using testing::input;
using testing::make_run;

Mesh generated(std::string_view kind, std::size_t size, std::uint64_t seed) {
  Progress progress;
  return generate_mesh(kind, size, seed, progress);
}

/// A piece over the meridian of 180 degrees; a band around the Earth.
Mesh piece() { return generated("wrapped", 300, 3); }
Mesh band() { return generated("globe", 300, 3); }

/// Some inner vertices thrown by more than an element, those near the seam first.
Mesh thrown(Mesh mesh, double near, double degrees) {
  const auto prepared = input(mesh);
  int count = 0;
  for (Index v = 0; v < mesh.vertex_count() && count < 6; ++v) {
    Vec3& p = mesh.positions[v];
    if (prepared->topology.boundary()[v] != 0 || std::abs(p.x) < 180.0 - near) continue;
    p = {p.x + (count % 2 == 0 ? degrees : -degrees), p.y + 0.7 * degrees, 0.0};
    if (p.x > 180.0) p.x -= 360.0;
    if (p.x < -180.0) p.x += 360.0;
    ++count;
  }
  EXPECT_EQ(count, 6);
  return mesh;
}

/// A piece shifted as by hand.
Mesh by_hand(Mesh mesh) {
  for (Vec3& p : mesh.positions)
    if (p.x < 0.0) p.x += 360.0;
  return mesh;
}

/// The piece with longitudes from 0 to 360.
Mesh from_zero(Mesh mesh) {
  for (Vec3& p : mesh.positions) p.x = p.x - 180.0 < 0.0 ? p.x + 180.0 : p.x - 180.0;
  return mesh;
}

/// Number of inverted elements, counted separately: each corner is brought next to the first one.
Index inverted_unwrapped(const Mesh& mesh, std::span<const Vec3> positions) {
  Index count = 0;
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    const auto c = mesh.elements.corners(e);
    const std::size_t n = c.size();
    std::vector<double> x, y;
    for (const Index v : c) {
      x.push_back(std::remainder(positions[v].x - positions[c[0]].x, 360.0));
      y.push_back(positions[v].y);
    }
    bool inverted = false;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t a = (i + 1) % n, b = (i + n - 1) % n;
      inverted = inverted || !((x[a] - x[i]) * (y[b] - y[i]) - (y[a] - y[i]) * (x[b] - x[i]) > 0.0);
    }
    count += inverted ? 1 : 0;
  }
  return count;
}

std::vector<RunParameters> every_way() {
  std::vector<RunParameters> ways;
  for (const MethodInfo& method : method_table())
    for (const Metric metric : {Metric::MeanRatio, Metric::MinAngle}) {
      RunParameters way;
      way.method = method.name;
      way.metric = metric;
      ways.push_back(way);
    }
  return ways;
}

std::string title_of(const RunParameters& way) { return way.method + " " + std::string(info(way.metric).name); }

TEST(Seam, NothingIsRuinedByAnyMethodOrderOrNumberOfThreads) {
  Progress progress;
  for (const auto& mesh : {input(piece()), input(band()), input(from_zero(piece()))}) {
    ASSERT_GT(mesh->report.seam_elements, 10U);
    const double west = mesh->geometry.plane.west;
    for (RunParameters way : every_way()) {
      if (!testing::defined_for_all(way.metric, mesh->mesh)) continue;
      std::vector<Vec3> first;
      for (const unsigned threads : {1U, 3U}) {
        SCOPED_TRACE(title_of(way));
        dmoscope::Run run = make_run(mesh, way, threads);
        const double before = run.statistics().minimum;
        run.iterate(4, progress, [&](const dmoscope::Run& now) {
          EXPECT_EQ(now.statistics().inverted, inverted_unwrapped(mesh->mesh, now.positions()));
          EXPECT_TRUE(now.statistics().inverted == 0U || !method_info(way.method).optimises);
        });
        EXPECT_TRUE(run.statistics().minimum > before || !method_info(way.method).optimises);
        for (const Vec3& p : run.positions()) EXPECT_TRUE(p.x >= west && p.x <= west + 360.0) << p.x;
        if (first.empty()) first.assign(run.positions().begin(), run.positions().end());
        EXPECT_TRUE(same_bits(first, run.positions()));
      }
      if (way.method != "dmo") continue;
      way.order.seed = 5;
      dmoscope::Run run = make_run(mesh, way);
      run.iterate(4, progress);
      EXPECT_EQ(inverted_unwrapped(mesh->mesh, run.positions()), 0U);
      EXPECT_GT(run.statistics().minimum, make_run(mesh, way).statistics().minimum);
    }
  }
}

/// Expects the wrapped mesh to be smoothed like the one shifted by hand.
void expect_as_by_hand(const Mesh& wrapped, const Mesh& shifted, RunParameters way) {
  SCOPED_TRACE(title_of(way));
  Progress progress;
  way.search.precision = Precision::Double;
  const auto here = input(wrapped), there = input(shifted);
  ASSERT_GT(here->geometry.plane.period, 0.0);
  ASSERT_EQ(there->geometry.plane.period, 0.0);
  EXPECT_EQ(here->report.inverted_elements, there->report.inverted_elements);
  EXPECT_NEAR(here->geometry.size, there->geometry.size, 1e-9);
  RunParameters shifted_way = way;
  if (way.combination && way.combination->size() != nullptr) std::get<SizeFunction>(shifted_way.combination->second).point.x += 360.0;
  dmoscope::Run a = make_run(here, way), b = make_run(there, shifted_way);
  for (dmoscope::Run* run : {&a, &b}) run->iterate(4, progress);
  EXPECT_GT(a.history().records()[1].moved, 0U);
  double farthest = 0.0;
  for (Index v = 0; v < wrapped.vertex_count(); ++v) {
    const Vec3 p = a.positions()[v], q = b.positions()[v];
    farthest = std::max({farthest, std::abs(std::remainder(p.x - q.x, 360.0)), std::abs(p.y - q.y)});
  }
  EXPECT_LT(farthest, 1e-9);
  EXPECT_EQ(a.statistics().inverted, b.statistics().inverted);
  EXPECT_NEAR(a.statistics().minimum, b.statistics().minimum, 1e-9);
  EXPECT_NEAR(a.statistics().mean, b.statistics().mean, 1e-9);
}

TEST(Seam, APieceIsSmoothedAsIfItWereShiftedByHand) {
  for (const RunParameters& way : every_way()) {
    expect_as_by_hand(piece(), by_hand(piece()), way);
    expect_as_by_hand(thrown(piece(), 4.0, 1.3), by_hand(thrown(piece(), 4.0, 1.3)), way);
  }
}

TEST(Seam, AimsAndSizesAreThoseOfThePieceShiftedByHand) {
  RunParameters way;
  way.combination = CompositeTerms{0.5, Metric::MinAngle};
  expect_as_by_hand(piece(), by_hand(piece()), way);
  for (const SizeFunction::Kind kind : {SizeFunction::Kind::Field, SizeFunction::Kind::Distance}) {
    SizeFunction size{};
    size.kind = kind;
    size.field = "depth";
    size.point = {-178.0, -17.0, 0.0};
    way.combination = CompositeTerms{0.3, size};
    expect_as_by_hand(piece(), by_hand(piece()), way);
  }
}

TEST(Seam, ATangledBandIsUntangledAcrossIt) {
  const auto mesh = input(thrown(band(), 15.0, 40.0));
  ASSERT_GT(mesh->report.inverted_elements.size(), 6U);
  EXPECT_EQ(mesh->report.inverted_elements.size(), inverted_unwrapped(mesh->mesh, mesh->mesh.positions));
  Progress progress;
  dmoscope::Run run = make_run(mesh, {});
  run.iterate(30, progress);
  EXPECT_EQ(inverted_unwrapped(mesh->mesh, run.positions()), 0U);
}

TEST(Seam, AFieldReadsTheSameOnBothSides) {
  // Linear over the unwrapped piece, so that its value at any place is known.
  const Mesh mesh = piece();
  const auto prepared = input(mesh);
  const auto value = [](Vec3 p) { return 3.0 * (p.x < 0.0 ? p.x + 360.0 : p.x) - 2.0 * p.y; };
  std::vector<double> values;
  for (const Vec3& p : mesh.positions) values.push_back(value(p));
  const NodalField field(prepared->mesh, prepared->topology, prepared->geometry.plane, values);
  int seen = 0;
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    const auto c = mesh.elements.corners(e);
    const Plane& plane = prepared->geometry.plane;
    const Vec3 origin = mesh.positions[c[0]];
    Vec3 middle = origin + 0.3 * plane.difference(mesh.positions[c[1]], origin) + 0.4 * plane.difference(mesh.positions[c[2]], origin);
    if (std::abs(middle.x) > 180.0) middle.x -= middle.x > 0.0 ? 360.0 : -360.0;
    seen += std::abs(middle.x) > 179.0 ? 1 : 0;
    for (const Index near : {c[0], Index{0}}) EXPECT_NEAR(field.at(near, middle), value(middle), 1e-8) << e;
  }
  EXPECT_GT(seen, 10);
}

TEST(Seam, AcceleratorsAreRefusedWithTheReason) {
  Progress progress;
  RunParameters way;
  way.backend = Backend::Cuda;
  try {
    (void)make_run(input(band()), way);
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("go round in longitude"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace dmoscope
