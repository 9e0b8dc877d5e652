#include "mpi/mesh/lattice.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dmoscope {
namespace {

constexpr double kJitter = 0.35;  // share of the distance of neighbours

/// Returns a number in [-1, 1) that depends on the arguments alone.
double noise(WholeIndex vertex, std::uint64_t axis) {
  std::uint64_t x = vertex * 3 + axis + 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  x ^= x >> 31U;
  return static_cast<double>(x >> 11U) * 0x1p-52 - 1.0;
}

class Lattice {
 public:
  Lattice(std::uint64_t vertices, bool volume) : volume_(volume) {
    const double root = volume ? std::cbrt(static_cast<double>(vertices)) : std::sqrt(static_cast<double>(vertices));
    side_ = std::max<std::uint64_t>(3, static_cast<std::uint64_t>(std::lround(root)));
  }
  [[nodiscard]] std::uint64_t vertices() const { return side_ * side_ * (volume_ ? side_ : 1); }
  [[nodiscard]] std::uint64_t cells() const { return (side_ - 1) * (side_ - 1) * (volume_ ? side_ - 1 : 1); }
  [[nodiscard]] std::uint64_t elements_of_cell() const { return volume_ ? 6 : 2; }

  [[nodiscard]] Vec3 position(WholeIndex v) const {
    std::array<double, 3> at{};
    WholeIndex rest = v;
    for (std::uint64_t axis = 0; axis < (volume_ ? 3U : 2U); ++axis, rest /= side_) {
      const std::uint64_t i = rest % side_;
      const bool inside = i > 0 && i + 1 < side_;
      at[axis] = static_cast<double>(i) + (inside ? kJitter * noise(v, axis) : 0.0);
    }
    return {at[0], at[1], at[2]};
  }
  /// Adds the elements of a cell: two triangles, or Kuhn's six tetrahedra, which meet those of the next cells.
  void add(std::uint64_t cell, MeshBlock& block) const {
    const std::uint64_t n = side_ - 1, i = cell % n, j = cell / n % n, k = cell / n / n;
    const auto at = [&](std::uint64_t x, std::uint64_t y, std::uint64_t z) { return (i + x) + side_ * ((j + y) + side_ * (k + z)); };
    if (!volume_) {
      add_element<3>(block, ElementKind::Triangle, {at(0, 0, 0), at(1, 0, 0), at(1, 1, 0)});
      add_element<3>(block, ElementKind::Triangle, {at(0, 0, 0), at(1, 1, 0), at(0, 1, 0)});
      return;
    }
    constexpr std::array<std::array<unsigned, 3>, 6> kOrders{{{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}}};
    for (std::size_t t = 0; t < kOrders.size(); ++t) {
      std::array<std::uint64_t, 3> step{};
      std::array<WholeIndex, 4> corners{at(0, 0, 0)};
      for (std::size_t s = 0; s < 3; ++s) {
        step[kOrders[t][s]] = 1;
        corners[s + 1] = at(step[0], step[1], step[2]);
      }
      if (t >= 3) std::swap(corners[1], corners[2]);  // odd permutations are inside out
      add_element(block, ElementKind::Tetrahedron, corners);
    }
  }

 private:
  template <std::size_t N>
  static void add_element(MeshBlock& block, ElementKind kind, const std::array<WholeIndex, N>& corners) {
    block.kinds.push_back(kind);
    block.corners.insert(block.corners.end(), corners.begin(), corners.end());
  }
  std::uint64_t side_ = 3;
  bool volume_;
};

}  // namespace

MeshBlock lattice_block(const World& world, std::uint64_t vertices, bool volume) {
  const Lattice lattice(vertices, volume);
  MeshBlock block;
  block.vertices = Ranges(lattice.vertices(), world.size());
  const Ranges cells(lattice.cells(), world.size());
  for (WholeIndex v = block.vertices.begin(world.rank()); v < block.vertices.end(world.rank()); ++v)
    block.positions.push_back(lattice.position(v));
  for (std::uint64_t cell = cells.begin(world.rank()); cell < cells.end(world.rank()); ++cell) lattice.add(cell, block);
  block.elements = world.ranges(block.kinds.size());
  return block;
}

}  // namespace dmoscope
