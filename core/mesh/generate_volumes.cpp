// Blocks of volume elements: a cube of cells, each cut into elements of the wanted kinds, with its inner vertices out of place, or thrown
// out of their stars.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "core/mesh/faces.h"
#include "core/mesh/generators.h"

namespace dmoscope::generators {

namespace {

/// A unit lattice of (n + 1)^3 vertices; cells have VTK's order of a hexahedron's corners.
class Block {
 public:
  explicit Block(std::size_t vertices)
      : n_(std::max<Index>(2, static_cast<Index>(std::lround(std::cbrt(static_cast<double>(vertices)))) - 1)) {}
  [[nodiscard]] Index cells() const { return n_; }
  [[nodiscard]] Index vertex(Index i, Index j, Index k) const { return i + (n_ + 1) * (j + (n_ + 1) * k); }
  [[nodiscard]] std::array<Index, 8> cell(Index i, Index j, Index k) const {
    return {vertex(i, j, k),     vertex(i + 1, j, k),     vertex(i + 1, j + 1, k),     vertex(i, j + 1, k),
            vertex(i, j, k + 1), vertex(i + 1, j, k + 1), vertex(i + 1, j + 1, k + 1), vertex(i, j + 1, k + 1)};
  }
  /// Positions with the inner vertices up to `jitter` of a cell out of place along each axis, and drawn towards the first corner: up to
  /// `bias` (below 1/3, from where on corners turn over) of a cell beside the surface, and further towards the middle.
  [[nodiscard]] std::vector<Vec3> positions(double jitter, std::uint64_t seed, double bias = 0.0) const {
    std::vector<Vec3> positions;
    positions.reserve(static_cast<std::size_t>(n_ + 1) * (n_ + 1) * (n_ + 1));
    Random random(seed);
    for (Index k = 0; k <= n_; ++k)
      for (Index j = 0; j <= n_; ++j)
        for (Index i = 0; i <= n_; ++i) {
          const auto inside = [this](Index a) { return a > 0 && a < n_; };
          const double moves = inside(i) && inside(j) && inside(k) ? 1.0 : 0.0;
          const auto along = [&](Index a) {
            const double drawn = bias * a * (1.0 - static_cast<double>(a) / n_);
            return neat(a + moves * (jitter * random.between(-1.0, 1.0) - drawn));
          };
          const double x = along(i), y = along(j), z = along(k);
          positions.push_back({x, y, z});
        }
    return positions;
  }
  template <class Visit>
  void for_cells(Progress& progress, const Visit& visit) const {
    for (Index k = 0; k < n_; ++k) {
      progress.check();
      progress.set(static_cast<double>(k) / n_);
      for (Index j = 0; j < n_; ++j)
        for (Index i = 0; i < n_; ++i) visit(i, j, k);
    }
  }

 private:
  Index n_;
};

/// Whether a column of cells is cut into wedges, so that neighbours fit: prisms are cut along the z axis only, and whole quadrilaterals
/// face the others.
bool cut_into_wedges(Index i, Index j) { return (i / 2 + j / 2) % 3 == 1; }
bool cut_into_pyramids(Index i, Index j, Index k) { return !cut_into_wedges(i, j) && (i / 2 + j / 2 + k / 2) % 2 == 1; }

/// Adds a cell as six pyramids around its middle. Towards a neighbour that is such a cell, too, the pyramid is cut in two tetrahedra, on
/// both sides along the same diagonal.
void add_pyramids(Mesh& mesh, const Block& block, Index i, Index j, Index k) {
  const std::array<Index, 8> c = block.cell(i, j, k);
  Vec3 middle;
  for (const Index v : c) middle = middle + 0.125 * mesh.positions[v];
  const auto tip = static_cast<Index>(mesh.positions.size());
  mesh.positions.push_back({neat(middle.x), neat(middle.y), neat(middle.z)});
  const Index n = block.cells();
  const auto same = [&](int di, int dj, int dk) {
    const auto at = [](Index a, int d) { return a + static_cast<Index>(d); };  // -1 wraps beyond n
    const Index x = at(i, di), y = at(j, dj), z = at(k, dk);
    return x < n && y < n && z < n && cut_into_pyramids(x, y, z);
  };
  // Neighbours that are such cells, in the order of faces_of(): bottom, top, front, right, back, left.
  const std::array<bool, 6> cut{same(0, 0, -1), same(0, 0, 1), same(0, -1, 0), same(1, 0, 0), same(0, 1, 0), same(-1, 0, 0)};
  for (std::size_t f = 0; f < 6; ++f) {
    std::array<Index, 4> face{};
    for (std::size_t m = 0; m < 4; ++m) face[m] = c[faces_of(ElementKind::Hexahedron)[f].corners[m]];
    std::reverse(face.begin(), face.end());  // counter-clockwise seen from the middle
    if (!cut[f]) {
      mesh.elements.add(ElementKind::Pyramid, std::array{face[0], face[1], face[2], face[3], tip});
      continue;
    }
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());  // cut at the lowest vertex on both sides
    mesh.elements.add(ElementKind::Tetrahedron, std::array{face[0], face[1], face[2], tip});
    mesh.elements.add(ElementKind::Tetrahedron, std::array{face[0], face[2], face[3], tip});
  }
}

Mesh hexahedra(const Request& request, double jitter, double bias) {
  const Block block(request.size);
  Mesh mesh;
  mesh.positions = block.positions(jitter, request.seed, bias);
  block.for_cells(request.progress, [&](Index i, Index j, Index k) { mesh.elements.add(ElementKind::Hexahedron, block.cell(i, j, k)); });
  return mesh;
}

}  // namespace

Mesh tetrahedra(const Request& request) {
  const Block block(request.size);
  Mesh mesh;
  mesh.positions = block.positions(0.2, request.seed);
  // Pairs of corners for six tetrahedra around the diagonal from corner 0 to corner 6 (Kuhn): neighbours cut their common faces alike.
  constexpr std::array<std::array<Index, 2>, 6> kAround{{{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}}};
  block.for_cells(request.progress, [&](Index i, Index j, Index k) {
    const std::array<Index, 8> c = block.cell(i, j, k);
    for (const auto& [a, b] : kAround) mesh.elements.add(ElementKind::Tetrahedron, std::array{c[0], c[a], c[b], c[6]});
  });
  return mesh;
}

Mesh hexahedra(const Request& request) { return hexahedra(request, 0.22, 0.0); }

Mesh biased(const Request& request) { return hexahedra(request, 0.02, 0.3); }

Mesh mixed_volumes(const Request& request) {
  const Block block(request.size);
  Mesh mesh;
  mesh.positions = block.positions(0.15, request.seed);
  block.for_cells(request.progress, [&](Index i, Index j, Index k) {
    const std::array<Index, 8> c = block.cell(i, j, k);
    if (cut_into_wedges(i, j)) {
      mesh.elements.add(ElementKind::Wedge, std::array{c[0], c[1], c[2], c[4], c[5], c[6]});
      mesh.elements.add(ElementKind::Wedge, std::array{c[0], c[2], c[3], c[4], c[6], c[7]});
    } else if (cut_into_pyramids(i, j, k)) {
      add_pyramids(mesh, block, i, j, k);
    } else {
      mesh.elements.add(ElementKind::Hexahedron, c);
    }
  });
  return mesh;
}

Mesh tangled_volumes(const Request& request) {
  const Block block(request.size);
  Mesh mesh = mixed_volumes(request);
  std::vector<Index> inner;
  const Index n = block.cells();
  for (Index k = 1; k < n; ++k)
    for (Index j = 1; j < n; ++j)
      for (Index i = 1; i < n; ++i) inner.push_back(block.vertex(i, j, k));
  const double middle = n / 2.0;  // middle of the cube, along each axis
  Random random(request.seed + 1);
  // Throws vertices beyond their stars, so that elements turn over, but towards the middle, so that none leaves the cube.
  const std::size_t thrown = std::max<std::size_t>(2, inner.size() / 20);
  for (std::size_t t = 0; t < thrown; ++t) {
    std::swap(inner[t], inner[t + random.below(inner.size() - t)]);
    Vec3& p = mesh.positions[inner[t]];
    // Draws a direction uniformly on the sphere: its height and its turn about the axis are uniform.
    const double height = random.between(-1.0, 1.0), across = std::sqrt(1.0 - height * height), turns = random.unit();
    Vec3 away = random.between(1.4, 1.8) * Vec3{across * cos_turns(turns), across * sin_turns(turns), height};
    const auto inwards = [middle](double way, double at) { return way * (at - middle) > 0.0 ? -way : way; };
    away = {inwards(away.x, p.x), inwards(away.y, p.y), inwards(away.z, p.z)};
    p = {neat(p.x + away.x), neat(p.y + away.y), neat(p.z + away.z)};
  }
  return mesh;
}

// Samples screw and elbow: rods of hexahedra that are swept along a curve, whose worst elements touch the surface, since a round section
// has the corners of a square. Sample can: the skin of such a rod.

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
