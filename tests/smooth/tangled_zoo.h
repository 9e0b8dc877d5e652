#pragma once
// Small meshes tangled in every way that real ones are: jolted, folded, with one number wrong, with swapped coordinates, turned inside out,
// with fixed vertices that make untangling impossible.

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/meshes.h"
#include "tests/support/volume_grids.h"

namespace dmoscope::testing {

/// Ways to spoil the positions of a mesh; each changes some of them, the boundary's included.
enum class Spoiling { Jolt, Fold, Sign, Digit, Swap, Far, Collapse, Mirror };
inline constexpr Spoiling kSpoilings[] = {Spoiling::Jolt, Spoiling::Fold, Spoiling::Sign,     Spoiling::Digit,
                                          Spoiling::Swap, Spoiling::Far,  Spoiling::Collapse, Spoiling::Mirror};

inline const char* name_of(Spoiling spoiling) {
  static constexpr const char* kNames[] = {"jolted", "folded", "sign", "digit", "swapped", "far", "collapsed", "mirrored"};
  return kNames[static_cast<std::size_t>(spoiling)];
}

/// The mesh, made `scale` times as large so that its edges are about 1 long, with positions spoiled at random.
inline Mesh spoiled(Mesh mesh, double scale, Spoiling spoiling, std::uint64_t seed) {
  for (Vec3& p : mesh.positions) p = scale * p;
  Random random(seed);
  const auto any = [&] { return static_cast<std::size_t>(random(0.0, 1.0) * static_cast<double>(mesh.positions.size())); };
  const bool volume = info(mesh.elements.kind(0)).dimension == 3;
  std::vector<Vec3>& at = mesh.positions;
  Vec3& one = at[any()];
  switch (spoiling) {
    case Spoiling::Jolt:
      for (Vec3& p : at) p = p + Vec3{random(-0.9, 0.9), random(-0.9, 0.9), volume ? random(-0.9, 0.9) : 0.0};
      break;
    case Spoiling::Fold: {
      const double line = one.x;
      for (Vec3& p : at)
        if (p.x > line) p.x = line - 0.7 * (p.x - line);
      break;
    }
    case Spoiling::Sign:
      one.y = -one.y;
      break;
    case Spoiling::Digit:
      one.x = one.x * 10.0 + 3.0;
      break;
    case Spoiling::Swap:
      std::swap(one.x, one.y);
      break;
    case Spoiling::Far:
      one = one + Vec3{random(-40.0, 40.0), random(-40.0, 40.0), volume ? random(-40.0, 40.0) : 0.0};
      break;
    case Spoiling::Collapse: {
      const Vec3 middle = one;
      for (Vec3& p : at)
        if (length(p - middle) < 1.6) p = middle;
      break;
    }
    case Spoiling::Mirror: {
      const Vec3 middle = one;
      for (Vec3& p : at)
        if (length(p - middle) < 2.1) p.x = 2.0 * middle.x - p.x;
      break;
    }
  }
  return mesh;
}

}  // namespace dmoscope::testing
