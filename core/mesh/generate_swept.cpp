// Samples screw and elbow: rods of hexahedra that are swept along a curve, whose worst elements touch the surface, since a round section
// has the corners of a square. Sample can: the skin of such a rod.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "core/mesh/generators.h"

namespace dmoscope::generators {

namespace {

constexpr double kJitter = 0.15;  // largest random offset, in cells

/// A lattice of n x n cells across and m along.
struct Rod {
  Index n, m;
  explicit Rod(std::size_t vertices)
      : n(std::max<Index>(2, static_cast<Index>(std::lround(std::cbrt(static_cast<double>(vertices) / 3.0))) - 1)), m(3 * n) {}
};

/// Maps the square from -1 to 1 to a disc; its corners then lie on a smooth circle.
Vec2<double> on_disc(double u, double v) { return {u * std::sqrt(1.0 - 0.5 * v * v), v * std::sqrt(1.0 - 0.5 * u * u)}; }

/// Sweeps a rod and moves its vertices at random, those on a side within it, those on an edge along it. place(section, along): position of
/// a point of the disc, at 0 to 1 along the rod.
Mesh swept(const Request& request, const std::function<Vec3(Vec2<double>, double)>& place) {
  const Rod rod(request.size);
  Mesh mesh;
  Random random(request.seed);
  const auto jittered = [&random](Index at, Index last) {
    const double way = kJitter * random.between(-1.0, 1.0);  // drawn for every vertex, so that none depends on others
    return (at + (at > 0 && at < last ? way : 0.0)) / last;
  };
  for (Index k = 0; k <= rod.m; ++k) {
    request.progress.check();
    request.progress.set(static_cast<double>(k) / rod.m);
    for (Index j = 0; j <= rod.n; ++j)
      for (Index i = 0; i <= rod.n; ++i) {
        const double u = 2.0 * jittered(i, rod.n) - 1.0, v = 2.0 * jittered(j, rod.n) - 1.0, along = jittered(k, rod.m);
        const Vec3 p = place(on_disc(u, v), along);
        mesh.positions.push_back({neat(p.x), neat(p.y), neat(p.z)});
      }
  }
  const auto vertex = [&rod](Index i, Index j, Index k) { return i + (rod.n + 1) * (j + (rod.n + 1) * k); };
  for (Index k = 0; k < rod.m; ++k)
    for (Index j = 0; j < rod.n; ++j)
      for (Index i = 0; i < rod.n; ++i)
        mesh.elements.add(ElementKind::Hexahedron,
                          std::array{vertex(i, j, k), vertex(i + 1, j, k), vertex(i + 1, j + 1, k), vertex(i, j + 1, k),
                                     vertex(i, j, k + 1), vertex(i + 1, j, k + 1), vertex(i + 1, j + 1, k + 1), vertex(i, j + 1, k + 1)});
  return mesh;
}

}  // namespace

/// Sample screw: a rod with two threads; its section is longer in one direction than in the other, and turns.
Mesh screw(const Request& request) {
  return swept(request, [](Vec2<double> p, double along) {
    const double size = 1.0 + 0.25 * (p.x * p.x - p.y * p.y), c = cos_turns(along), s = sin_turns(along);
    return Vec3{size * (c * p.x - s * p.y), size * (s * p.x + c * p.y), 6.0 * along};
  });
}

/// Sample elbow: a quarter of a ring that gets thicker from one end to the other.
Mesh elbow(const Request& request) {
  return swept(request, [](Vec2<double> p, double along) {
    const double size = 0.3 + 0.3 * along * along, c = cos_turns(0.25 * along), s = sin_turns(0.25 * along), across = 1.0 + size * p.x;
    return Vec3{across * c, across * s, -size * p.y};
  });
}

/// Sample can: the skin of a rod twice as long as it is wide. A cell at a corner of the square, which lies on a smooth curve, is split
/// through that corner; the others are split at random.
Mesh can(const Request& request) {
  const auto n = std::max<Index>(2, static_cast<Index>(std::lround(std::sqrt(static_cast<double>(request.size) / 10.0))));
  const Index m = 2 * n, row = n + 1;
  Mesh mesh;
  Random random(request.seed);
  std::vector<Index> number(std::size_t{row} * row * (m + 1), kNoIndex);  // vertex of each point of the lattice
  const auto jittered = [&random](Index at, Index last) {
    const double way = 2.0 * kJitter * random.between(-1.0, 1.0);
    return (at + (at > 0 && at < last ? way : 0.0)) / last;
  };
  const auto on_skin = [n, m](Index i, Index j, Index k) { return i == 0 || i == n || j == 0 || j == n || k == 0 || k == m; };
  const auto point = [row](Index i, Index j, Index k) { return i + row * (j + row * std::size_t{k}); };
  for (Index k = 0; k <= m; ++k) {
    request.progress.check();
    request.progress.set(static_cast<double>(k) / m);
    for (Index j = 0; j <= n; ++j)
      for (Index i = 0; i <= n; ++i) {
        if (!on_skin(i, j, k)) continue;
        number[point(i, j, k)] = mesh.vertex_count();
        const double u = 2.0 * jittered(i, n) - 1.0, v = 2.0 * jittered(j, n) - 1.0, along = jittered(k, m);
        const Vec2<double> p = on_disc(u, v);
        mesh.positions.push_back({neat(p.x), neat(p.y), neat(4.0 * along)});
      }
  }
  const auto add = [&](std::array<std::size_t, 4> points, bool first) {
    std::array<Index, 4> c{};
    std::ranges::transform(points, c.begin(), [&number](std::size_t p) { return number[p]; });
    if (!first) std::rotate(c.begin(), c.begin() + 1, c.end());
    mesh.elements.add(ElementKind::Triangle, std::array{c[0], c[1], c[2]});
    mesh.elements.add(ElementKind::Triangle, std::array{c[0], c[2], c[3]});
  };
  const auto any = [&random] { return random.between(0.0, 1.0) < 0.5; };
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) {
      const bool rises = (i == 0 && j == 0) || (i + 1 == n && j + 1 == n), falls = (i == 0 && j + 1 == n) || (i + 1 == n && j == 0);
      const bool chance = any(), first = rises || (!falls && chance), second = rises || (!falls && any());
      add({point(i, j, m), point(i + 1, j, m), point(i + 1, j + 1, m), point(i, j + 1, m)}, first);
      add({point(i, j, 0), point(i, j + 1, 0), point(i + 1, j + 1, 0), point(i + 1, j, 0)}, second);
    }
  for (Index k = 0; k < m; ++k)
    for (Index i = 0; i < n; ++i) {
      add({point(i, 0, k), point(i + 1, 0, k), point(i + 1, 0, k + 1), point(i, 0, k + 1)}, any());
      add({point(i + 1, n, k), point(i, n, k), point(i, n, k + 1), point(i + 1, n, k + 1)}, any());
      add({point(0, i + 1, k), point(0, i, k), point(0, i, k + 1), point(0, i + 1, k + 1)}, any());
      add({point(n, i, k), point(n, i + 1, k), point(n, i + 1, k + 1), point(n, i, k + 1)}, any());
    }
  return mesh;
}

}  // namespace dmoscope::generators
