// Crossing faces of surfaces: their count against all pairs, and warnings if sliding makes more of them.

#include "core/run/crossing_faces.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "tests/smooth/sliding.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {
namespace crossing_faces {

using namespace testing;
using ::testing::HasSubstr;

/// Whether the segment meets the triangle, by its parameters there (Moeller and Trumbore).
bool meets(Vec3 p, Vec3 q, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 way = q - p, ab = b - a, ac = c - a, normal = cross(ab, ac);
  const double along = -dot(normal, way);
  if (along == 0.0) return false;
  const double t = dot(normal, p - a) / along;
  if (!(t > 0.0 && t < 1.0)) return false;
  const Vec3 at = p + t * way - a;
  const double u = dot(cross(at, ac), normal) / dot(normal, normal), v = dot(cross(ab, at), normal) / dot(normal, normal);
  return u > 0.0 && v > 0.0 && u + v < 1.0;
}

std::vector<std::array<Vec3, 3>> halves(const ElementTable& faces, std::span<const Vec3> at, Index f) {
  const auto c = faces.corners(f);
  const auto p = [&](std::size_t i) { return at[c[i]]; };
  if (c.size() == 3) return {{p(0), p(1), p(2)}};
  if (length(p(2) - p(0)) <= length(p(3) - p(1))) return {{p(0), p(1), p(2)}, {p(0), p(2), p(3)}};
  return {{p(0), p(1), p(3)}, {p(1), p(2), p(3)}};
}

/// Counts by testing every pair.
std::uint64_t by_brute_force(const ElementTable& faces, std::span<const Vec3> at) {
  std::uint64_t count = 0;
  for (Index f = 0; f < faces.size(); ++f)
    for (Index g = f + 1; g < faces.size(); ++g) {
      bool apart = true, crossing = false;
      for (const Index v : faces.corners(f))
        for (const Index w : faces.corners(g)) apart = apart && v != w;
      for (const auto& s : halves(faces, at, f))
        for (const auto& t : halves(faces, at, g))
          for (std::size_t i = 0; i < 3; ++i)
            crossing = crossing || meets(s[i], s[(i + 1) % 3], t[0], t[1], t[2]) || meets(t[i], t[(i + 1) % 3], s[0], s[1], s[2]);
      count += apart && crossing ? 1 : 0;
    }
  return count;
}

/// Two sheets, one around the other like parts of two pipes, `gap` apart.
Mesh sheets(Index n, double gap, std::uint64_t seed, bool quadrilaterals) {
  Mesh mesh;
  testing::Random random(seed);
  for (const double radius : {1.0, 1.0 + gap}) {
    const Index first = mesh.vertex_count();
    for (Index j = 0; j <= n; ++j)
      for (Index i = 0; i <= n; ++i) {
        const double jitter = i == 0 || j == 0 || i == n || j == n ? 0.0 : 0.25;
        const double angle = 0.8 * std::numbers::pi * ((i + jitter * random(-1.0, 1.0)) / n - 0.5),
                     z = (j + jitter * random(-1.0, 1.0)) / n;
        mesh.positions.push_back({radius * std::sin(angle), radius * std::cos(angle), z});
      }
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < n; ++i) {
        const Index k = first + j * (n + 1) + i;
        if (quadrilaterals) {
          testing::add(mesh, {k, k + 1, k + n + 2, k + n + 1});
        } else {
          testing::add(mesh, {k, k + 1, k + n + 2});
          testing::add(mesh, {k, k + n + 2, k + n + 1});
        }
      }
  }
  return mesh;
}

TEST(CrossingFaces, AreAsManyAsEveryPairByItselfTells) {
  std::uint64_t some = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    testing::Random random(seed);
    Mesh mesh;
    for (int i = 0; i < 120; ++i) mesh.positions.push_back({random(-1.0, 1.0), random(-1.0, 1.0), random(-1.0, 1.0)});
    for (Index i = 0; i < 120; ++i) testing::add(mesh, {i, (i + 1) % 120, (i + 7) % 120});
    for (const Mesh& one : {mesh, sheets(8, 0.003, seed, false), sheets(8, 0.003, seed, true)}) {
      EXPECT_EQ(count_crossing_faces(one.elements, one.positions), by_brute_force(one.elements, one.positions)) << seed;
      some += count_crossing_faces(one.elements, one.positions);
    }
  }
  EXPECT_GT(some, 1000U);
}

TEST(CrossingFaces, OfSheetsNearerThanTheBoundAreToldOf) {
  for (const Mesh& one : {sheets(12, 0.012, 6, false), sheets(12, 0.009, 1, true)}) {
    const auto mesh = input(one);
    RunParameters parameters;
    parameters.max_deviation = 0.02;
    const auto look = [&](const RunParameters& by) {
      dmoscope::Run run = make_run(mesh, by);
      Progress progress;
      run.iterate(10, progress);
      const auto found = find_crossing_faces(run);
      EXPECT_EQ(found ? found->after : 0, by_brute_force(mesh->mesh.elements, run.positions()));
      return found;
    };
    const auto found = look(parameters);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->before, by_brute_force(mesh->mesh.elements, mesh->mesh.positions));
    EXPECT_THAT(found->sentence(), HasSubstr("a smaller max-deviation than 0.02 keeps them apart"));
    parameters.max_deviation = 1e-3;
    EXPECT_FALSE(look(parameters));
  }
}

TEST(CrossingFaces, OfAMeshInAPlaneAreNotLookedFor) {
  dmoscope::Run run = make_run(input(lattice(4, 0.3, 1)), RunParameters{});
  EXPECT_FALSE(find_crossing_faces(run));
}

}  // namespace crossing_faces
}  // namespace
}  // namespace dmoscope
