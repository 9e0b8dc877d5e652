#pragma once
// Meshes for the smoothing tests whose stars have every form that the lanes treat differently, and places and sizes that are hard for
// floats.

#include <cmath>
#include <string>
#include <vector>

#include "core/quality/metric.h"
#include "core/search/parameters.h"
#include "tests/support/meshes.h"

namespace dmoscope::testing {

/// Stars side by side, each around a free hub beside its middle. `sectors[i]`: of star i, 3 for a triangle and 4 for a quadrilateral each,
/// counter-clockwise. With `layers` every hub has as many such stars, which share nothing but the hub.
inline Mesh stars(const std::vector<std::vector<int>>& sectors, std::uint64_t seed, int layers = 1) {
  Mesh mesh;
  mesh.name = "stars";
  Random random(seed);
  const auto point = [&mesh](double x, double y) {
    mesh.positions.push_back({x, y, 0.0});
    return static_cast<Index>(mesh.positions.size() - 1);
  };
  const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(sectors.size()))));
  for (std::size_t i = 0; i < sectors.size(); ++i) {
    const double x = 4.0 * static_cast<double>(i % columns), y = 4.0 * static_cast<double>(i / columns);
    const Index hub = point(x + random(-0.25, 0.25), y + random(-0.25, 0.25));
    const auto count = static_cast<Index>(sectors[i].size());
    for (int layer = 0; layer < layers; ++layer) {
      const auto at = [&](double sector, double low, double high) {
        const double angle = 2 * M_PI * (sector + random(-0.2, 0.2)) / count, radius = random(low, high);
        return point(x + radius * std::cos(angle), y + radius * std::sin(angle));
      };
      std::vector<Index> ring;
      for (Index s = 0; s < count; ++s) ring.push_back(at(s, 0.8, 1.0));
      for (Index s = 0; s < count; ++s) {
        const Index b = ring[s], d = ring[(s + 1) % count];
        if (sectors[i][s] == 3)
          add(mesh, {hub, b, d});
        else
          add(mesh, {hub, b, at(s + 0.5, 1.3, 1.6), d});
      }
    }
  }
  return mesh;
}

/// Hubs of the valences 3 to 40, `copies` of each.
inline Mesh wheels(int copies) {
  std::vector<std::vector<int>> sectors;
  for (std::size_t valence = 3; valence <= 40; ++valence)
    sectors.insert(sectors.end(), static_cast<std::size_t>(copies), std::vector<int>(valence, 3));
  return stars(sectors, 31);
}

/// Hubs whose star is two closed fans, one above the other.
inline Mesh two_layers() {
  std::vector<std::vector<int>> sectors;
  for (std::size_t valence = 3; valence <= 12; ++valence) sectors.insert(sectors.end(), 2, std::vector<int>(valence, 3));
  return stars(sectors, 32, 2);
}

/// Hubs of up to 20 triangles and 8 quadrilaterals.
inline Mesh mixed_stars() {
  std::vector<std::vector<int>> sectors;
  for (const std::size_t triangles : {0U, 1U, 3U, 8U, 16U, 17U, 20U})
    for (const std::size_t quadrilaterals : {1U, 2U, 3U, 6U, 7U, 8U}) {
      std::vector<int> star(triangles, 3);
      for (std::size_t i = 0; i < quadrilaterals; ++i)
        star.insert(star.begin() + static_cast<std::ptrdiff_t>(i * star.size() / quadrilaterals), 4);
      if (star.size() >= 3) sectors.push_back(star);
    }
  return stars(sectors, 33);
}

/// A disc with a hole, whose elements grow from 1e-12 to 1.
inline Mesh graded() {
  constexpr Index kRings = 41, kSectors = 8;
  Mesh mesh;
  mesh.name = "graded";
  Random random(34);
  for (Index i = 0; i < kRings; ++i)
    for (Index j = 0; j < kSectors; ++j) {
      const bool inside = i > 0 && i + 1 < kRings;
      const double radius = 1e-12 * std::exp2(i + (inside ? random(-0.3, 0.3) : 0.0));
      const double angle = 2 * M_PI * (j + 0.5 * (i % 2) + (inside ? random(-0.2, 0.2) : 0.0)) / kSectors;
      mesh.positions.push_back({radius * std::cos(angle), radius * std::sin(angle), 0.0});
    }
  for (Index i = 0; i + 1 < kRings; ++i)
    for (Index j = 0; j < kSectors; ++j) {
      const Index next = (j + 1) % kSectors, inner = i * kSectors, outer = inner + kSectors;
      if (i % 2 == 0) {  // the outer ring is half a sector ahead
        add(mesh, {inner + j, outer + j, inner + next});
        add(mesh, {inner + next, outer + j, outer + next});
      } else {
        add(mesh, {inner + j, outer + j, outer + next});
        add(mesh, {inner + j, outer + next, inner + next});
      }
    }
  return mesh;
}

/// `mesh` with its vertices at map(position).
template <class Map>
Mesh mapped(Mesh mesh, Map map) {
  for (Vec3& p : mesh.positions) p = map(p);
  return mesh;
}

struct Specimen {
  std::string name;
  Mesh mesh;
  SearchParameters search{};
};

/// All meshes above, and lattices in many places.
inline std::vector<Specimen> zoo() {
  std::vector<Specimen> all;
  const char* const names[] = {"triangles", "quadrilaterals", "mixed"};
  for (const Cells cells : {Cells::Triangles, Cells::Quadrilaterals, Cells::Mixed}) {
    const std::string name = names[static_cast<std::size_t>(cells)];
    all.push_back({name, lattice(14, 0.3, 41, cells)});
    all.push_back({name + ", tangled", lattice(9, 0.9, 42, cells)});
    for (const int points : {5, 9})
      all.push_back({name + ", grid " + std::to_string(points), lattice(7, 0.4, 43, cells), {.grid_points = points}});
    for (const int levels : {1, 2, 4, 5})
      all.push_back({name + ", levels " + std::to_string(levels), lattice(7, 0.4, 44, cells), {.levels = levels}});
  }
  all.push_back({"wheels", wheels(2)});
  all.push_back({"two layers", two_layers()});
  all.push_back({"mixed stars", mixed_stars()});
  all.push_back({"graded", graded()});
  for (const Cells cells : {Cells::Triangles, Cells::Mixed}) {
    const Mesh base = lattice(7, 0.4, 45, cells);
    const auto place = [&](const char* name, auto map) { all.push_back({name, mapped(base, map)}); };
    place("far from the origin", [](Vec3 p) { return Vec3{p.x + 1e6, p.y - 1e6, 0}; });
    place("tilted", [](Vec3 p) { return Vec3{0.6 * p.x + 7, p.y - 3, 0.8 * p.x + 2}; });
    place("tilted and far", [](Vec3 p) { return Vec3{0.48 * p.x - 0.8 * p.y + 1e6, 0.6 * p.x + 1e6, 0.64 * p.x + 0.6 * p.y - 1e6}; });
    place("parallel to xz", [](Vec3 p) { return Vec3{p.x, -0.0, p.y}; });
    place("parallel to yz", [](Vec3 p) { return Vec3{-5, p.x, p.y}; });
    place("minute", [](Vec3 p) { return 1e-30 * p; });
    place("huge", [](Vec3 p) { return 1e30 * p; });
    Mesh single = mapped(base, [](Vec3 p) { return Vec3{static_cast<float>(p.x + 1e4), static_cast<float>(p.y + 1e4), 0}; });
    single.single_precision = true;
    all.push_back({"single precision", std::move(single)});
  }
  return all;
}

/// Whether the metric is defined for all elements of the mesh.
inline bool defined_for_all(Metric metric, const Mesh& mesh) {
  for (const ElementKind kind : mesh.elements.kinds())
    if (!info(metric).defined_for(kind)) return false;
  return true;
}

}  // namespace dmoscope::testing
