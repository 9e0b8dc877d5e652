#pragma once
// Sound meshes of all kinds of elements whose free vertices are tangled: their places before are a solution.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/meshes.h"
#include "tests/support/volume_grids.h"

namespace dmoscope::testing {

/// Movement that tangles the free vertices, or those in a part of the mesh.
enum class Tangling { Swapped, Folded, Scrambled, Turned, Jolted, Collapsed, Mirrored, Strewn };
inline constexpr std::array kTanglings{Tangling::Swapped, Tangling::Folded,    Tangling::Scrambled, Tangling::Turned,
                                       Tangling::Jolted,  Tangling::Collapsed, Tangling::Mirrored,  Tangling::Strewn};
inline const char* name_of(Tangling tangling) {
  static constexpr std::array kNames{"swapped", "folded", "scrambled", "turned", "jolted", "collapsed", "mirrored", "strewn"};
  return kNames[static_cast<std::size_t>(tangling)];
}

/// Kinds of sound meshes, over the unit square or cube, straight or bent round a corner.
enum class Sound { Triangles, Quadrilaterals, MixedPlane, Tetrahedra, Hexahedra, Wedges, MixedVolume };
inline constexpr std::array kSounds{Sound::Triangles, Sound::Quadrilaterals, Sound::MixedPlane, Sound::Tetrahedra,
                                    Sound::Hexahedra, Sound::Wedges,         Sound::MixedVolume};
inline const char* name_of(Sound sound) {
  static constexpr std::array kNames{"triangles", "quadrilaterals", "mixed plane", "tetrahedra", "hexahedra", "wedges", "mixed volume"};
  return kNames[static_cast<std::size_t>(sound)];
}
inline bool is_volume(Sound sound) { return sound >= Sound::Tetrahedra; }

/// Sound mesh with so many cells along each side, its vertices a little off the lattice.
inline Mesh sound_mesh(Sound sound, Index cells, bool bent, unsigned seed) {
  constexpr std::array kPlane{Cells::Triangles, Cells::Quadrilaterals, Cells::Mixed};
  constexpr std::array kSpace{test::Fill::Tetrahedra, test::Fill::Hexahedra, test::Fill::Wedges, test::Fill::Mixed};
  const auto i = static_cast<std::size_t>(sound);
  Mesh mesh = is_volume(sound) ? test::volume_grid(cells, kSpace[i - kPlane.size()], 0.1, seed) : lattice(cells, 0.1, seed, kPlane[i]);
  for (Vec3& p : mesh.positions) {
    if (!bent) continue;
    const double r = 0.4 + p.y, angle = 2.5 * p.x;
    p = {r * std::cos(angle), r * std::sin(angle), p.z + 0.3 * p.x};
    if (!is_volume(sound)) p.z = 0.0;
  }
  return mesh;
}

/// Mesh with vertices elsewhere that are not fixed. `cell`: rough length of an edge.
inline Mesh tangled(Mesh mesh, std::span<const std::uint8_t> fixed, Tangling tangling, double cell, bool volume, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3>& at = mesh.positions;
  std::vector<Index> free;
  Vec3 low = at[0], high = at[0];
  for (Index v = 0; v < at.size(); ++v) {
    if (fixed[v] == 0) free.push_back(v);
    low = {std::min(low.x, at[v].x), std::min(low.y, at[v].y), std::min(low.z, at[v].z)};
    high = {std::max(high.x, at[v].x), std::max(high.y, at[v].y), std::max(high.z, at[v].z)};
  }
  const auto any = [&] { return free[static_cast<std::size_t>(random(0.0, 1.0) * 0.999999 * static_cast<double>(free.size()))]; };
  const auto off = [&](double most) { return Vec3{random(-most, most), random(-most, most), volume ? random(-most, most) : 0.0}; };
  const auto anywhere = [&] { return Vec3{random(low.x, high.x), random(low.y, high.y), volume ? random(low.z, high.z) : low.z}; };
  const Vec3 middle = at[any()];
  const double near = random(1.5, 3.5) * cell, angle = random(1.0, 3.1);
  if (tangling == Tangling::Swapped)
    for (int i = 0; i < 6; ++i) std::swap(at[any()], at[any()]);
  for (const Index v : free) {
    Vec3& p = at[v];
    const Vec3 from = p - middle;
    switch (tangling) {
      case Tangling::Swapped:
        break;
      case Tangling::Folded:  // a sheet
        if (std::fabs(from.x) < near) p.x = middle.x - from.x;
        break;
      case Tangling::Scrambled:
        p = anywhere();
        break;
      case Tangling::Turned:
        if (length(from) < near)
          p = middle +
              Vec3{std::cos(angle) * from.x - std::sin(angle) * from.y, std::sin(angle) * from.x + std::cos(angle) * from.y, from.z};
        break;
      case Tangling::Jolted:
        p = p + off(1.2 * cell);
        break;
      case Tangling::Collapsed:
        if (length(from) < near) p = middle;
        break;
      case Tangling::Mirrored:
        if (length(from) < near) p.y = middle.y - from.y;
        break;
      case Tangling::Strewn:  // some, far away
        if (random(0.0, 1.0) < 0.1) p = p + off(20.0);
        break;
    }
  }
  return mesh;
}

}  // namespace dmoscope::testing
