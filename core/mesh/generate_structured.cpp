// Samples block, annulus, quads, mixed and tangled: lattices bent to a shape and then distorted.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "core/mesh/generators.h"

namespace dmoscope::generators {
namespace {

Index at_least(double value, Index lowest) { return std::max(lowest, static_cast<Index>(std::lround(value))); }

/// A random offset, at most `reach` in each direction.
Vec3 jitter(Random& random, double reach) {
  const double x = random.between(-reach, reach);
  return {x, random.between(-reach, reach), 0.0};
}

/// Vertices of all blocks, each made once even if several blocks share it.
class BlockVertices {
 public:
  explicit BlockVertices(Index cells) : cells_(cells) {}

  /// Vertex (i, j), 0 to cells, of the block with these corners (counter-clockwise) at these places.
  Index vertex(int block, const std::array<int, 4>& corner, const std::array<Vec3, 4>& place, Index i, Index j) {
    const double s = static_cast<double>(i) / cells_;
    const double t = static_cast<double>(j) / cells_;
    const Vec3 low = (1.0 - s) * place[0] + s * place[1];
    const Vec3 high = (1.0 - s) * place[3] + s * place[2];
    const auto [found, fresh] = index_.try_emplace(key(block, corner, i, j), static_cast<Index>(positions.size()));
    if (fresh) positions.push_back((1.0 - t) * low + t * high);
    return found->second;
  }

  std::vector<Vec3> positions;

 private:
  using Key = std::tuple<int, int, Index, Index>;
  [[nodiscard]] Key key(int block, const std::array<int, 4>& corner, Index i, Index j) const {
    if (j == 0) return edge(corner[0], corner[1], i);
    if (j == cells_) return edge(corner[3], corner[2], i);
    if (i == 0) return edge(corner[0], corner[3], j);
    if (i == cells_) return edge(corner[1], corner[2], j);
    return {-1, block, i, j};
  }
  [[nodiscard]] Key edge(int a, int b, Index k) const {
    if (k == 0) return {a, a, 0, 0};
    if (k == cells_) return {b, b, 0, 0};
    return a < b ? Key{a, b, k, 0} : Key{b, a, cells_ - k, 0};
  }
  Index cells_;
  std::map<Key, Index> index_;
};

}  // namespace

// Sample block: five blocks around the middle (valence 5), ten around those; valence 3 at the five outer corners of the inner ones.
Mesh block(const Request& request) {
  const Index n = at_least(std::sqrt(static_cast<double>(request.size) / 15.0), 2);
  std::vector<Vec3> macro{{0, 0, 0}};
  for (const double radius : {1.0, 2.0}) {
    for (int k = 0; k < 10; ++k) {
      const double bulge = radius * (k % 2 == 0 ? 0.9 : 1.1);
      macro.push_back({bulge * cos_turns(k / 10.0 + 0.25), bulge * sin_turns(k / 10.0 + 0.25), 0});
    }
  }
  std::vector<std::array<int, 4>> blocks;
  for (int k = 0; k < 10; k += 2) blocks.push_back({0, 1 + k, 2 + k, 1 + (k + 2) % 10});
  for (int k = 0; k < 10; ++k) blocks.push_back({1 + k, 11 + k, 11 + (k + 1) % 10, 1 + (k + 1) % 10});

  BlockVertices vertices(n);
  Mesh mesh;
  for (int b = 0; b < static_cast<int>(blocks.size()); ++b) {
    request.progress.check();
    request.progress.set(static_cast<double>(b) / static_cast<double>(blocks.size()));
    const auto& corner = blocks[static_cast<std::size_t>(b)];
    std::array<Vec3, 4> place;
    for (std::size_t i = 0; i < 4; ++i) place[i] = macro[static_cast<std::size_t>(corner[i])];
    const auto vertex = [&](Index i, Index j) { return vertices.vertex(b, corner, place, i, j); };
    for (Index j = 0; j < n; ++j) {
      for (Index i = 0; i < n; ++i) {
        const Index a = vertex(i, j);
        const Index c = vertex(i + 1, j + 1);
        mesh.elements.add(ElementKind::Triangle, std::array{a, vertex(i + 1, j), c});
        mesh.elements.add(ElementKind::Triangle, std::array{a, c, vertex(i, j + 1)});
      }
    }
  }
  mesh.positions = std::move(vertices.positions);
  for (Vec3& p : mesh.positions) p = {neat(p.x), neat(p.y), 0.0};
  std::vector<Vec3> offsets;
  for (const Vec3& p : mesh.positions) {
    const double fade = std::max(0.0, 1.0 - dot(p, p) / 4.0);  // the rim is bent less than the middle
    offsets.push_back((0.35 + 0.6 * fade) * Vec3{fractal_noise(1.3 * p.x, 1.3 * p.y, 2, request.seed),
                                                 fractal_noise(1.3 * p.x + 40.0, 1.3 * p.y, 2, request.seed + 1), 0.0});
  }
  displace(mesh, offsets, 1e6, request.progress);
  return mesh;
}

Mesh annulus(const Request& request) {
  // Number of rings: radii are 1 to 3, so there are 6.28 times as many cells around the middle circle as across the ring.
  const Index rings = at_least(std::sqrt(static_cast<double>(request.size) / 6.28) - 0.5, 2);
  const Index sectors = at_least(static_cast<double>(request.size) / (rings + 1), 6);
  Mesh mesh;
  std::vector<Vec3> offsets;
  Random random(request.seed);
  const double cell = 2.0 / rings;
  for (Index j = 0; j <= rings; ++j) {
    request.progress.check();
    for (Index i = 0; i < sectors; ++i) {
      const double t = static_cast<double>(j) / rings;
      const double radius = 1.0 + 2.0 * t;
      const double turns = (i + 0.5 * (j % 2)) / sectors;
      const Vec3 p{radius * cos_turns(turns), radius * sin_turns(turns), 0.0};
      mesh.positions.push_back({neat(p.x), neat(p.y), 0.0});
      // Shears along the circles, most at a third and two thirds of the way, in opposite directions; the rims stay.
      const double sheared = turns + 0.06 * sin_turns(t) * (1.0 + 0.5 * noise(4.0 * p.x, 4.0 * p.y, request.seed));
      const Vec3 q{radius * cos_turns(sheared), radius * sin_turns(sheared), 0.0};
      const bool inside = j > 0 && j < rings;
      offsets.push_back(inside ? (q - p) + jitter(random, 0.22 * cell) : Vec3{});
    }
  }
  // Alternates the diagonals, since rows are shifted by half a cell against each other.
  add_cells(mesh.elements, sectors, rings, true, [](Index, Index j) { return j % 2 == 0 ? Cell::FallingDiagonal : Cell::RisingDiagonal; });
  // Reverses the elements: angles grow counter-clockwise and radii outwards, so the lattice is mirrored.
  for (Index e = 0; e < mesh.elements.size(); ++e) mesh.elements.flip(e);
  displace(mesh, offsets, 1e6, request.progress);
  return mesh;
}

Mesh quads(const Request& request) {
  const Index ny = at_least(std::sqrt(static_cast<double>(request.size) / 3.0) - 1.0, 2);
  const Index nx = at_least(static_cast<double>(request.size) / (ny + 1) - 1.0, 2);
  Mesh mesh;
  std::vector<Vec3> offsets;
  Random random(request.seed);
  const auto arch = [](double s, double t) {
    // Runs from right to left along the arch, so that s and t are a right-handed pair.
    const double turns = 0.5 - 0.5 * s;
    const double radius = 1.0 + t * (0.9 + 0.15 * cos_turns(2.0 * s));
    return Vec3{1.2 * radius * cos_turns(turns), radius * sin_turns(turns), 0.0};
  };
  const double cell = std::min(3.0 / nx, 0.9 / ny);
  for (Index j = 0; j <= ny; ++j) {
    request.progress.check();
    for (Index i = 0; i <= nx; ++i) {
      const double s = static_cast<double>(i) / nx;
      const double t = static_cast<double>(j) / ny;
      const Vec3 p = arch(s, t);
      mesh.positions.push_back({neat(p.x), neat(p.y), 0.0});
      const double wave = 0.055 * sin_turns(0.5 * s) * sin_turns(0.5 * t);
      const Vec3 q = arch(s + wave * sin_turns(3.0 * t + 0.5 * noise(3.0 * s, 2.0 * t, request.seed)), t + 2.2 * wave * sin_turns(3.0 * s));
      const bool inside = i > 0 && j > 0 && i < nx && j < ny;
      offsets.push_back(inside ? (q - p) + jitter(random, 0.25 * cell) : Vec3{});
    }
  }
  add_cells(mesh.elements, nx, ny, false, [](Index, Index) { return Cell::Quadrilateral; });
  displace(mesh, offsets, 1e6, request.progress);
  return mesh;
}

Mesh mixed(const Request& request) {
  const Index ny = at_least(std::sqrt(static_cast<double>(request.size) / 2.2) - 1.0, 4);
  const Index nx = at_least(static_cast<double>(request.size) / (ny + 1) - 1.0, 4);
  const Index layers = std::max<Index>(2, ny / 3);  // layers of quadrilaterals
  Mesh mesh;
  std::vector<Vec3> offsets;
  Random random(request.seed);
  for (Index j = 0; j <= ny; ++j) {
    request.progress.check();
    for (Index i = 0; i <= nx; ++i) {
      const double s = static_cast<double>(i) / nx;
      const double t = static_cast<double>(j) / ny;
      const double x = 3.0 * s;
      const double d = (x - 1.5) / 0.45;
      const double wall = 0.28 / (1.0 + d * d * d * d);  // height of the bump
      const double up = t * (0.55 + 0.45 * t);           // height above the wall, with thin layers at it
      mesh.positions.push_back({neat(x), neat(wall + (1.4 - wall) * up), 0.0});
      const double height = 1.4 * (0.55 + 0.9 * t) / ny;
      const double reach = j <= layers ? 0.3 : 0.42;
      const bool inside = i > 0 && j > 0 && i < nx && j < ny;
      const Vec3 drawn = jitter(random, reach);
      offsets.push_back(inside ? Vec3{drawn.x * 3.0 / nx, drawn.y * height, 0.0} : Vec3{});
    }
  }
  add_cells(mesh.elements, nx, ny, false, [&](Index, Index j) {
    if (j < layers) return Cell::Quadrilateral;
    return random.below(2) == 0 ? Cell::RisingDiagonal : Cell::FallingDiagonal;
  });
  displace(mesh, offsets, 1e6, request.progress);
  return mesh;
}

Mesh tangled(const Request& request) {
  const Index n = at_least(std::sqrt(static_cast<double>(request.size)) - 1.0, 4);
  Mesh mesh;
  std::vector<Vec3> offsets;
  std::vector<Index> interior;
  Random random(request.seed);
  for (Index j = 0; j <= n; ++j) {
    for (Index i = 0; i <= n; ++i) {
      const bool inside = i > 0 && j > 0 && i < n && j < n;
      if (inside) interior.push_back(static_cast<Index>(mesh.positions.size()));
      mesh.positions.push_back({double(i), double(j), 0.0});
      offsets.push_back(inside ? jitter(random, 0.2) : Vec3{});
    }
  }
  // Uses quadrilaterals in the lower left half, triangles in the upper right one.
  add_cells(mesh.elements, n, n, false, [&](Index i, Index j) {
    if (i + j < n) return Cell::Quadrilateral;
    return random.below(2) == 0 ? Cell::RisingDiagonal : Cell::FallingDiagonal;
  });
  displace(mesh, offsets, 1e6, request.progress);
  // Throws vertices beyond their stars, so that elements turn over, but towards the middle, so that the mesh keeps its outline.
  const std::size_t thrown = std::max<std::size_t>(1, interior.size() / 20);
  for (std::size_t k = 0; k < thrown; ++k) {
    std::swap(interior[k], interior[k + random.below(interior.size() - k)]);
    Vec3& p = mesh.positions[interior[k]];
    const double turns = random.unit();
    Vec3 away = random.between(1.9, 2.4) * Vec3{cos_turns(turns), sin_turns(turns), 0.0};
    if (dot(away, p - Vec3{n / 2.0, n / 2.0, 0.0}) > 0) away = -1.0 * away;
    p = {neat(p.x + away.x), neat(p.y + away.y), 0.0};
  }
  return mesh;
}

}  // namespace dmoscope::generators
