#include "core/mesh/seam.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "core/mesh/edges.h"
#include "core/mesh/orientation.h"
#include "core/mesh/winding_sets.h"

namespace dmoscope {
namespace {

constexpr double kCircle = 360.0, kHalf = 180.0, kPole = 90.0;
constexpr double kFarthest = 720.0;  // largest absolute longitude that files have
constexpr double kRounding = 1e-9;   // degrees by which a file's numbers may exceed their range
constexpr double kFarMore = 2.0;     // ratio of mended to broken elements, see find_seam()
constexpr double kWidest = 90.0;     // largest width of an element on the Earth, unwrapped, in degrees

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] double width() const { return high - low; }
  [[nodiscard]] bool within(double a, double b) const { return low >= a - kRounding && high <= b + kRounding; }
};

struct Degrees {
  Range x, y;
  /// Ranges of the positions. Stops once something lies beyond the poles, as it does in most meshes.
  explicit Degrees(const Mesh& mesh) {
    for (const Index v : mesh.elements.all_corners()) {
      const Vec3 p = mesh.degrees ? (*mesh.degrees)[v] : mesh.positions[v];
      x.add(p.x);
      y.add(p.y);
      if (!y.within(-kPole, kPole)) return;
    }
  }
};

/// Whether an element is wider than half the circle; `shown(x)`: the longitude that is shown for x.
template <class Shown>
bool is_wide(const Mesh& mesh, Index e, const Shown& shown) {
  Range x;
  for (const Index v : mesh.elements.corners(e)) x.add(shown(mesh.positions[v].x));
  return x.width() > kHalf;
}

bool is_in_degrees(const Range& x, const Range& y) {
  return y.within(-kPole, kPole) && x.width() > kHalf && x.width() <= kCircle + kRounding && x.within(-kFarthest, kFarthest);
}

bool is_longitude_and_latitude(const Plane& plane) { return plane.u == Vec3{1, 0, 0} && plane.v == Vec3{0, 1, 0}; }

double west_of(const Range& x) {
  if (x.within(-kHalf, kHalf)) return -kHalf;
  if (x.within(0.0, kCircle)) return 0.0;
  return x.low;
}

/// Whether every corner is positive, in the winding `sign`, and the element not too wide. `plane` takes the differences.
bool is_sound(const Mesh& mesh, Index e, const Plane& plane, double sign) {
  const auto c = mesh.elements.corners(e);
  const std::size_t n = c.size();
  std::array<Vec2<double>, 4> at;
  Range x;
  for (std::size_t i = 0; i < n; ++i) {
    at[i] = plane.offset(mesh.positions[c[i]], mesh.positions[c[0]]);
    x.add(at[i].x);
  }
  if (plane.period > 0.0 && x.width() > kWidest) return false;
  for (std::size_t i = 0; i < n; ++i)
    if (!(sign * cross(at[(i + 1) % n] - at[i], at[(i + n - 1) % n] - at[i]) > 0.0)) return false;
  return true;
}

/// Positive winding of each element: that of the majority of the narrow elements of its component.
class Windings {
 public:
  Windings(const Mesh& mesh, const Topology& topology, const EdgeSurvey& edges, std::span<const Index> wide)
      : edges_(edges), votes_(edges.components) {
    Index contradictions = 0;
    if (!edges.consistent) against_ = relate_windings(mesh, topology, contradictions);
    auto next = wide.begin();
    const double whole = box_measure(mesh, 2);
    for (Index e = 0; e < mesh.elements.size(); ++e) {
      if (next != wide.end() && *next == e) {
        ++next;
      } else if (edges.component[e] != kNoIndex) {
        const double area = area_vector(mesh, e).z;
        votes_[edges.component[e]].add(is_against(e) ? -area : area, whole);
      }
    }
  }
  [[nodiscard]] double sign(Index e) const {
    const Index component = edges_.component[e];
    return component != kNoIndex && is_against(e) != votes_[component].reverse() ? -1.0 : 1.0;
  }

 private:
  [[nodiscard]] bool is_against(Index e) const { return !against_.empty() && against_[e] != 0; }
  const EdgeSurvey& edges_;
  std::vector<std::uint8_t> against_;  // whether each element is wound against the first; empty: none is
  std::vector<WindingVote> votes_;
};

/// The east end of the widest stretch of longitudes without elements; `plain` unless an element lies across that.
double find_cut(const Mesh& mesh, double plain, double& width) {
  std::vector<double> all;
  all.reserve(mesh.elements.all_corners().size());
  for (const Index v : mesh.elements.all_corners()) all.push_back(mesh.positions[v].x);
  std::ranges::sort(all);
  double gap = all.front() + kCircle - all.back(), cut = all.front();
  for (std::size_t i = 1; i < all.size(); ++i)
    if (all[i] - all[i - 1] > gap) gap = all[i] - all[i - 1], cut = all[i];
  const auto shown = [cut](double x) { return x < cut ? x + kCircle : x; };
  for (Index e = 0; e < mesh.elements.size(); ++e)
    if (is_wide(mesh, e, shown)) return plain;
  width = kCircle - gap;
  return cut;
}

}  // namespace

bool might_wrap(const Plane& plane, Vec3 low, Vec3 high) {
  return is_longitude_and_latitude(plane) && is_in_degrees({low.x, high.x}, {low.y, high.y});
}

bool is_wide(const Mesh& mesh, Index element) {
  return is_wide(mesh, element, [](double x) { return x; });
}

void find_seam(const Mesh& mesh, const Topology& topology, const EdgeSurvey& edges, Geometry& geometry) {
  const Plane plain = geometry.plane;
  if (geometry.shape != Shape::Planar || !is_longitude_and_latitude(plain)) return;
  const Degrees box(mesh);
  if (!is_in_degrees(box.x, box.y)) return;
  std::vector<Index> wide;
  for (Index e = 0; e < mesh.elements.size(); ++e)
    if (is_wide(mesh, e)) wide.push_back(e);
  if (wide.empty()) return;

  Plane wrapped = plain;
  wrapped.period = kCircle;
  wrapped.west = wrapped.cut = west_of(box.x);
  const Windings windings(mesh, topology, edges, wide);
  std::size_t gained = 0, lost = 0;
  for (const Index e : wide) {
    const bool before = is_sound(mesh, e, plain, windings.sign(e)), after = is_sound(mesh, e, wrapped, windings.sign(e));
    gained += after && !before ? 1 : 0;
    lost += before && !after ? 1 : 0;
  }
  if (!(static_cast<double>(gained) > kFarMore * static_cast<double>(lost))) return;
  double width = box.x.width();
  wrapped.cut = find_cut(mesh, wrapped.west, width);
  geometry.plane = wrapped;
  geometry.size = std::hypot(width, box.y.width());
}

Index count_seam_elements(const Mesh& mesh, const Plane& plane) {
  Index count = 0;
  if (plane.period > 0.0)
    for (Index e = 0; e < mesh.elements.size(); ++e) count += is_wide(mesh, e) ? 1 : 0;
  return count;
}

std::string left_out_of_pictures(Index seam_elements, const Plane& plane) {
  if (seam_elements == 0 || plane.cut != plane.west) return {};
  return seam_elements == 1 ? "pictures leave out the element that crosses the meridian"
                            : fmt::format("pictures leave out the {} elements that cross the meridian", seam_elements);
}

double meridian_of_seam(const Plane& plane) {
  if (!(plane.period > 0.0)) return 0.0;
  return plane.west == -kHalf ? kHalf : plane.west;
}

}  // namespace dmoscope
