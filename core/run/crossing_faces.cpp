#include "core/run/crossing_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/reference/domain.h"

namespace dmoscope {
namespace {

using Triangle = std::array<Vec3, 3>;

/// Side of the plane through a, b and c on which the point d lies: 1, -1, or 0 where rounding decides (Shewchuk: Adaptive precision
/// floating-point arithmetic and fast robust geometric predicates, 1997).
int side(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  a = a - d, b = b - d, c = c - d;
  const double ab = a.x * b.y, ba = b.x * a.y, bc = b.x * c.y, cb = c.x * b.y, ca = c.x * a.y, ac = a.x * c.y;
  const double volume = a.z * (bc - cb) + b.z * (ca - ac) + c.z * (ab - ba);
  const double sizes = (std::abs(bc) + std::abs(cb)) * std::abs(a.z) + (std::abs(ca) + std::abs(ac)) * std::abs(b.z) +
                       (std::abs(ab) + std::abs(ba)) * std::abs(c.z);
  const double rounding = 8.0 * 0x1p-53 * sizes;
  return volume > rounding ? 1 : volume < -rounding ? -1 : 0;
}

bool goes_through(Vec3 p, Vec3 q, const Triangle& t) {
  if (side(t[0], t[1], t[2], p) * side(t[0], t[1], t[2], q) >= 0) return false;
  const int first = side(p, q, t[0], t[1]);
  return first != 0 && side(p, q, t[1], t[2]) == first && side(p, q, t[2], t[0]) == first;
}

bool cross_each_other(const Triangle& a, const Triangle& b) {
  for (std::size_t i = 0; i < 3; ++i)
    if (goes_through(a[i], a[(i + 1) % 3], b) || goes_through(b[i], b[(i + 1) % 3], a)) return true;
  return false;
}

}  // namespace

std::uint64_t count_crossing_faces(const ElementTable& faces, std::span<const Vec3> positions) {
  std::vector<Triangle> triangles;
  std::vector<Index> face_of;
  for (Index f = 0; f < faces.size(); ++f) {
    const auto c = faces.corners(f);
    const auto add = [&](std::size_t i, std::size_t j, std::size_t k) {
      triangles.push_back({positions[c[i]], positions[c[j]], positions[c[k]]});
      face_of.push_back(f);
    };
    if (c.size() == 3) {
      add(0, 1, 2);
      continue;
    }
    const Vec3 one = positions[c[2]] - positions[c[0]], other = positions[c[3]] - positions[c[1]];
    const std::size_t first = dot(one, one) <= dot(other, other) ? 0 : 1;
    add(first, 1 + first, 2 + first), add(first, 2 + first, (3 + first) % 4);
  }
  const auto share_a_vertex = [&](Index f, Index g) {
    const auto there = faces.corners(g);
    return std::ranges::any_of(faces.corners(f), [&](Index v) { return std::ranges::find(there, v) != there.end(); });
  };
  std::vector<std::pair<Index, Index>> found;
  const FacetTree tree(triangles, std::vector<Index>(triangles.size()));
  tree.for_overlapping([&](Index a, Index b) {
    const auto [f, g] = std::minmax(face_of[a], face_of[b]);
    if (!share_a_vertex(f, g) && cross_each_other(triangles[a], triangles[b])) found.emplace_back(f, g);
  });
  std::ranges::sort(found);
  return static_cast<std::uint64_t>(std::unique(found.begin(), found.end()) - found.begin());
}

std::string CrossingFaces::sentence() const {
  return fmt::format(
      "{} of faces cross{} each other, and {} in the input. The bound of deviation lets parts of a surface meet that are nearer to each "
      "other: "
      "a smaller max-deviation than {:g} keeps them apart.",
      after == 1 ? "1 pair" : fmt::format("{} pairs", after), after == 1 ? "es" : "", before == 0 ? "none" : fmt::format("{}", before),
      max_deviation);
}

std::optional<CrossingFaces> find_crossing_faces(const Run& run) {
  if (!run.domain() || !run.domain()->faces().any()) return std::nullopt;
  const ElementTable& faces = run.domain()->faces().table();
  CrossingFaces found{.after = count_crossing_faces(faces, run.positions()), .max_deviation = run.parameters().max_deviation};
  if (found.after == 0) return std::nullopt;
  found.before = count_crossing_faces(faces, run.input().mesh.positions);
  return found.after > found.before ? std::optional(found) : std::nullopt;
}

}  // namespace dmoscope
