#pragma once
// Curved surfaces of many kinds.

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/smooth/surface_judge.h"
#include "tests/support/volume_grids.h"

namespace dmoscope::testing {

/// The boundary of a volume as a mesh of its own; quadrilaterals whole, or every other one, or all of them split.
inline Mesh skin(const Mesh& volume, Cells cells) {
  Mesh mesh;
  std::vector<Index> now(volume.vertex_count(), kNoIndex);
  Index count = 0;
  for (auto face : boundary_faces(volume)) {
    for (Index& v : face) {
      if (now[v] == kNoIndex) {
        now[v] = mesh.vertex_count();
        mesh.positions.push_back(volume.positions[v]);
      }
      v = now[v];
    }
    const bool whole = cells == Cells::Quadrilaterals || (cells == Cells::Mixed && count++ % 2 == 0);
    if (face.size() == 3) {
      testing::add(mesh, {face[0], face[1], face[2]});
    } else if (whole) {
      testing::add(mesh, {face[0], face[1], face[2], face[3]});
    } else {
      testing::add(mesh, {face[0], face[1], face[2]});
      testing::add(mesh, {face[0], face[2], face[3]});
    }
  }
  return mesh;
}

/// A lattice closed in one direction, or both; `half`: with half a turn, as a Moebius band.
inline Mesh wound(Index n, Index m, bool both, bool half, std::uint64_t seed, Cells cells, Vec3 (*map)(double, double)) {
  Mesh mesh;
  dmoscope::testing::Random random(seed);
  const Index rows = both ? m : m + 1;
  for (Index j = 0; j < rows; ++j)
    for (Index i = 0; i < n; ++i) {
      const bool inside = both || (j > 0 && j < m);
      mesh.positions.push_back(map((i + random(-0.25, 0.25)) / n, (j + (inside ? random(-0.25, 0.25) : 0.0)) / m));
    }
  const auto at = [&](Index i, Index j) {
    if (i == n && half) return (m - j) * n;
    return (j % rows) * n + i % n;
  };
  for (Index j = 0; j < m; ++j)
    for (Index i = 0; i < n; ++i) {
      if (cells == Cells::Quadrilaterals || (cells == Cells::Mixed && (i + j) % 2 == 0)) {
        testing::add(mesh, {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      } else {
        testing::add(mesh, {at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        testing::add(mesh, {at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  return mesh;
}
inline Vec3 on_torus(double u, double v) {
  const double a = 2 * M_PI * u, b = 2 * M_PI * v;
  return {(2 + 0.7 * std::cos(b)) * std::cos(a), (2 + 0.7 * std::cos(b)) * std::sin(a), 0.7 * std::sin(b)};
}
inline Vec3 on_cylinder(double u, double v) { return {std::cos(2 * M_PI * u), std::sin(2 * M_PI * u), 3 * v}; }
inline Vec3 on_moebius(double u, double v) {
  const double a = 2 * M_PI * u, w = 0.6 * (v - 0.5);
  return {(1 + w * std::cos(a / 2)) * std::cos(a), (1 + w * std::cos(a / 2)) * std::sin(a), w * std::sin(a / 2)};
}

inline std::vector<Specimen> surfaces() {
  std::vector<Specimen> all;
  std::uint64_t seed = 90;
  const auto graph = [&](double jitter, Cells cells, Vec3 (*map)(Vec3)) { return mapped(lattice(8, jitter, seed, cells), map); };
  for (const Cells cells : {Cells::Triangles, Cells::Quadrilaterals, Cells::Mixed}) {
    ++seed;
    const Mesh block = shaken(test::volume_grid(4, test::Fill::Hexahedra), 0.08, seed);
    all.push_back({"cube", skin(block, cells)});
    all.push_back({"sphere", skin(mapped(block, ball), cells)});
    all.push_back({"torus", wound(24, 9, true, false, seed, cells, on_torus)});
    all.push_back({"cylinder", wound(16, 6, false, false, seed, cells, on_cylinder)});
    all.push_back({"Moebius band", wound(24, 4, false, true, seed, cells, on_moebius)});
    all.push_back({"hill", graph(0.35, cells, [](Vec3 p) { return Vec3{p.x, p.y, 0.2 * std::sin(5 * p.x) * std::cos(4 * p.y)}; })});
    all.push_back({"crease that ends inside", graph(0.2, cells, [](Vec3 p) {
                     return Vec3{p.x, p.y, p.y > 0.5 ? 2 * (p.y - 0.5) * std::max(0.0, 0.6 - p.x) : 0.0};
                   })});
    all.push_back({"folded", graph(0.9, cells, [](Vec3 p) { return Vec3{p.x, p.y, 0.3 * p.x * p.x}; })});
    all.push_back({"tiny", graph(0.3, cells, [](Vec3 p) { return Vec3{1e-9 * p.x, 1e-9 * p.y, 2e-10 * p.x * p.y}; })});
    all.push_back({"far", graph(0.3, cells, [](Vec3 p) { return Vec3{1e4 + p.x, p.y - 1e4, 0.2 * p.x * p.y + 1e4}; })});
    all.push_back({"stretched", graph(0.3, cells, [](Vec3 p) { return Vec3{200 * p.x, p.y, 0.1 * p.y * p.y}; })});
    Mesh single = graph(0.3, cells, [](Vec3 p) {
      return Vec3{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(0.3 * p.x * p.x)};
    });
    single.single_precision = true;
    all.push_back({"single precision", std::move(single)});
    all.push_back({"thin plate", skin(mapped(block, [](Vec3 p) { return Vec3{p.x, p.y, 1e-5 * p.z}; }), cells)});
    // A third sheet on the middle row, whose edges have three elements then; and a sheet that touches in one vertex alone.
    Mesh tee = graph(0.3, cells, [](Vec3 p) { return Vec3{p.x, p.y, 0.1 * p.x * p.x}; });
    const Index first = tee.vertex_count();
    for (Index i = 0; i <= 8; ++i) tee.positions.push_back(tee.positions[4 * 9 + i] + Vec3{0, 0, 0.3});
    for (Index i = 0; i < 8; ++i) testing::add(tee, {36 + i, 37 + i, first + i + 1, first + i});
    tee.positions.push_back({0.3, 0.3, 1}), tee.positions.push_back({0.4, 0.3, 1});
    testing::add(tee, {22, first + 9, first + 10});
    all.push_back({"three sheets", std::move(tee)});
  }
  return all;
}

}  // namespace dmoscope::testing
