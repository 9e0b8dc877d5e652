#pragma once
// Small vectors. Vec3 is where a vertex stands (double, as in the file); Vec2 is a point of the mesh's
// plane in whatever scalar computes with it (double, float, a pack of floats).

#include <cmath>
#include <cstdint>

#include "core/base/anywhere.h"

namespace dmoscope {

/// Index of a vertex, an element or a corner. Meshes with 2^32 - 1 or more of either are refused at load.
using Index = std::uint32_t;
inline constexpr Index kNoIndex = 0xffffffffU;

struct Vec3 {
  double x = 0.0, y = 0.0, z = 0.0;
  friend DMOSCOPE_ANYWHERE Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend DMOSCOPE_ANYWHERE Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend DMOSCOPE_ANYWHERE Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
  friend DMOSCOPE_ANYWHERE bool operator==(const Vec3&, const Vec3&) = default;
};
[[nodiscard]] DMOSCOPE_ANYWHERE double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
[[nodiscard]] DMOSCOPE_ANYWHERE Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
[[nodiscard]] inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }

template <class Real>
struct Vec2 {
  Real x{}, y{};
  friend DMOSCOPE_ANYWHERE Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend DMOSCOPE_ANYWHERE Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
};
template <class Real>
[[nodiscard]] DMOSCOPE_ANYWHERE Real dot(Vec2<Real> a, Vec2<Real> b) {
  return a.x * b.x + a.y * b.y;
}
/// z component of the cross product: twice the signed area of the triangle (0, a, b).
template <class Real>
[[nodiscard]] DMOSCOPE_ANYWHERE Real cross(Vec2<Real> a, Vec2<Real> b) {
  return a.x * b.y - a.y * b.x;
}

}  // namespace dmoscope
