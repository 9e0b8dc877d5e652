// Rods of hexahedra that are swept along a curve: their worst elements touch the surface, where a round section has the corners of a
// square.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "core/mesh/generators.h"

namespace dmoscope::generators {

namespace {

constexpr double kJitter = 0.15;  // of a cell

/// A lattice of n x n cells across and m along.
struct Rod {
  Index n, m;
  explicit Rod(std::size_t vertices)
      : n(std::max<Index>(2, static_cast<Index>(std::lround(std::cbrt(static_cast<double>(vertices) / 3.0))) - 1)), m(3 * n) {}
};

/// The square from -1 to 1, made a disc: its corners lie on a smooth circle then.
Vec2<double> on_disc(double u, double v) { return {u * std::sqrt(1.0 - 0.5 * v * v), v * std::sqrt(1.0 - 0.5 * u * u)}; }

/// Vertices out of place, but those on a side on it, and those on an edge along this. place(section, along): where a point of the disc is,
/// from 0 to 1 along the rod.
Mesh swept(const Request& request, const std::function<Vec3(Vec2<double>, double)>& place) {
  const Rod rod(request.size);
  Mesh mesh;
  Random random(request.seed);
  const auto jittered = [&random](Index at, Index last) {
    const double way = kJitter * random.between(-1.0, 1.0);  // drawn for all, so that none depends on where others are
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

/// A rod with two threads: its section is longer one way than the other, and turns.
Mesh screw(const Request& request) {
  return swept(request, [](Vec2<double> p, double along) {
    const double size = 1.0 + 0.25 * (p.x * p.x - p.y * p.y), c = cos_turns(along), s = sin_turns(along);
    return Vec3{size * (c * p.x - s * p.y), size * (s * p.x + c * p.y), 6.0 * along};
  });
}

/// A quarter of a ring that gets thicker from one end to the other.
Mesh elbow(const Request& request) {
  return swept(request, [](Vec2<double> p, double along) {
    const double size = 0.3 + 0.3 * along * along, c = cos_turns(0.25 * along), s = sin_turns(0.25 * along), across = 1.0 + size * p.x;
    return Vec3{across * c, across * s, -size * p.y};
  });
}

}  // namespace dmoscope::generators
