#include "core/mesh/plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/box.h"

namespace dmoscope {
namespace {

constexpr double kPlanarTolerance = 1e-6;

using Matrix3 = std::array<std::array<double, 3>, 3>;

constexpr Plane kZ{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
constexpr Plane kX{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
constexpr Plane kY{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};

std::array<double, 3> components(Vec3 a) { return {a.x, a.y, a.z}; }

int largest_component(Vec3 a) {
  const auto c = components(a);
  // Factor within which components tie: ties go to z, then x, the order in which exact planes are tried.
  constexpr double kTie = 1.0 + 1e-9;
  int best = 2;
  for (const int i : {0, 1}) {
    if (std::abs(c[static_cast<std::size_t>(i)]) > kTie * std::abs(c[static_cast<std::size_t>(best)])) best = i;
  }
  return best;
}

const Plane& coordinate_plane(int axis) { return axis == 0 ? kX : axis == 1 ? kY : kZ; }

/// Normal of the least-squares plane: the eigenvector of the smallest eigenvalue of a symmetric matrix, by cyclic Jacobi rotations.
Vec3 smallest_eigenvector(Matrix3 a) {
  Matrix3 vectors{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (int sweep = 0; sweep < 60; ++sweep) {
    bool rotated = false;
    for (const auto& [p, q] : {std::pair<std::size_t, std::size_t>{0, 1}, {0, 2}, {1, 2}}) {
      if (std::abs(a[p][q]) <= std::numeric_limits<double>::min()) continue;
      rotated = true;
      const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
      const double t = (theta >= 0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
      const double c = 1.0 / std::sqrt(t * t + 1.0);
      const double s = t * c;
      const std::size_t r = 3 - p - q;
      const double apq = a[p][q];
      a[p][p] -= t * apq;
      a[q][q] += t * apq;
      a[p][q] = a[q][p] = 0.0;
      const double arp = a[r][p];
      const double arq = a[r][q];
      a[r][p] = a[p][r] = c * arp - s * arq;
      a[r][q] = a[q][r] = s * arp + c * arq;
      for (auto& row : vectors) {
        const double vp = row[p];
        const double vq = row[q];
        row[p] = c * vp - s * vq;
        row[q] = s * vp + c * vq;
      }
    }
    if (!rotated) break;
  }
  std::size_t k = 0;
  for (const std::size_t i : {1U, 2U}) {
    if (a[i][i] < a[k][k]) k = i;
  }
  return {vectors[0][k], vectors[1][k], vectors[2][k]};
}

/// The frame of tangent_plane(), for a normal of any length whose largest component is made positive.
Plane frame(Vec3 normal) {
  normal = (1.0 / length(normal)) * normal;
  if (components(normal)[static_cast<std::size_t>(largest_component(normal))] < 0) normal = -1.0 * normal;
  return tangent_plane(normal);
}

Vec3 mean_area_vector(const Mesh& mesh) {
  Vec3 sum;
  for (Index e = 0; e < mesh.elements.size(); ++e) sum = sum + area_vector(mesh, e);
  return sum;
}

/// Whether most elements are parallel to the plane.
bool mostly_parallel(const Mesh& mesh, const Plane& plane) {
  Index parallel = 0;
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    const Vec3 area = area_vector(mesh, e);
    const double across = dot(area, plane.normal);
    parallel += across * across >= (1.0 - 1e-12) * dot(area, area) ? 1 : 0;
  }
  return parallel > mesh.elements.size() / 2;
}

/// Best plane of the used vertices; sets deviation and plane.
void fit(const Mesh& mesh, const std::vector<std::uint8_t>& used, const PointBox& box, Geometry& geometry) {
  // Scales offsets from the middle of the box by its size: no digits are lost far from the origin, nothing over- or underflows.
  const Vec3 middle = box.low + 0.5 * (box.high - box.low);
  const double scale = 1.0 / geometry.size;
  Vec3 mean;
  double count = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (used[v] == 0) continue;
    mean = mean + scale * (mesh.positions[v] - middle);
    ++count;
  }
  mean = (1.0 / count) * mean;
  Matrix3 covariance{};
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (used[v] == 0) continue;
    const auto d = components(scale * (mesh.positions[v] - middle) - mean);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) covariance[i][j] += d[i] * d[j];
    }
  }
  geometry.plane = frame(smallest_eigenvector(covariance));
  double deviation = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (used[v] == 0) continue;
    deviation = std::max(deviation, std::abs(dot(scale * (mesh.positions[v] - middle) - mean, geometry.plane.normal)));
  }
  geometry.deviation = deviation * geometry.size;
}

}  // namespace

double diagonal(Vec3 low, Vec3 high) {
  const Vec3 d = high - low;
  const double most = std::max({d.x, d.y, d.z});
  if (!(most > 0.0) || !std::isfinite(most)) return most;
  return most * length(Vec3{d.x / most, d.y / most, d.z / most});
}

std::optional<Plane> coordinate_plane_of(Vec3 low, Vec3 high) {
  if (low.z == high.z) return kZ;
  if (low.x == high.x) return kX;
  if (low.y == high.y) return kY;
  return std::nullopt;
}

Plane tangent_plane(Vec3 normal) {
  Vec3 u = coordinate_plane(largest_component(normal)).u;
  u = u - dot(u, normal) * normal;
  u = (1.0 / length(u)) * u;
  return {u, cross(normal, u), normal};
}

Vec3 area_vector(const Mesh& mesh, Index element, const Plane& plane) {
  const auto c = mesh.elements.corners(element);
  const auto way = [&](std::size_t from, std::size_t to) { return plane.difference(mesh.positions[c[to]], mesh.positions[c[from]]); };
  return c.size() == 3 ? cross(way(0, 1), way(0, 2)) : cross(way(0, 2), way(1, 3));
}

Geometry classify(const Mesh& mesh) {
  Geometry geometry;
  std::vector<std::uint8_t> used(mesh.positions.size(), 0);
  for (const Index v : mesh.elements.all_corners()) used[v] = 1;
  PointBox box;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (used[v] != 0) box.add(mesh.positions[v]);
  }
  if (mesh.elements.size() == 0) return geometry;
  geometry.size = diagonal(box.low, box.high);
  const bool volume = std::ranges::any_of(mesh.elements.kinds(), [](ElementKind k) { return info(k).dimension == 3; });
  if (volume) geometry.shape = Shape::Volume;

  if (const auto plane = coordinate_plane_of(box.low, box.high)) {
    geometry.plane = *plane;
  } else {
    fit(mesh, used, box, geometry);
    if (!volume && !(geometry.deviation <= kPlanarTolerance * geometry.size)) {
      geometry.shape = Shape::Surface;
      geometry.plane = coordinate_plane(largest_component(mean_area_vector(mesh)));
      geometry.mostly_flat = mostly_parallel(mesh, geometry.plane);
    }
  }
  return geometry;
}

}  // namespace dmoscope
