#pragma once
// Small vectors. Vec3 is a vertex's position (double, as in the file); Vec2 is a point of a planar mesh's plane and Vec3Of an offset in
// space, in the scalar of the computation (double, float, a pack of floats).

#include <cmath>
#include <cstdint>

#include "core/base/host_device.h"

namespace dmoscope {

/// Index of a vertex, an element or a corner. Meshes with 2^32 - 1 or more of either are refused at load.
using Index = std::uint32_t;
inline constexpr Index kNoIndex = 0xffffffffU;

template <class Real>
struct Vec3Of {
  Real x{}, y{}, z{};
  friend DMOSCOPE_ANYWHERE Vec3Of operator+(Vec3Of a, Vec3Of b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend DMOSCOPE_ANYWHERE Vec3Of operator-(Vec3Of a, Vec3Of b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend DMOSCOPE_ANYWHERE Vec3Of operator*(Real s, Vec3Of a) { return {s * a.x, s * a.y, s * a.z}; }
  friend DMOSCOPE_ANYWHERE bool operator==(const Vec3Of& a, const Vec3Of& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
};
using Vec3 = Vec3Of<double>;
template <class Real>
[[nodiscard]] DMOSCOPE_ANYWHERE Real dot(Vec3Of<Real> a, Vec3Of<Real> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
[[nodiscard]] DMOSCOPE_ANYWHERE Vec3Of<Real> cross(Vec3Of<Real> a, Vec3Of<Real> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }

template <class Real>
struct Vec2 {
  Real x{}, y{};
  friend DMOSCOPE_ANYWHERE Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend DMOSCOPE_ANYWHERE Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend DMOSCOPE_ANYWHERE bool operator==(const Vec2& a, const Vec2& b) { return a.x == b.x && a.y == b.y; }
};
template <class Real>
[[nodiscard]] DMOSCOPE_ANYWHERE Real dot(Vec2<Real> a, Vec2<Real> b) {
  return a.x * b.x + a.y * b.y;
}
/// The z component of the cross product: twice the signed area of the triangle (0, a, b).
template <class Real>
[[nodiscard]] DMOSCOPE_ANYWHERE Real cross(Vec2<Real> a, Vec2<Real> b) {
  return a.x * b.y - a.y * b.x;
}

}  // namespace dmoscope
