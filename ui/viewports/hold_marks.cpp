#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/inspect/joint_hold.h"
#include "render/draw_order.h"
#include "ui/analysis/holding_colours.h"
#include "ui/toolkit/screen_occupancy.h"
#include "ui/viewports/cased_lines.h"
#include "ui/viewports/mesh_marks.h"

namespace dmoscope::ui {
namespace {

constexpr double kLongestForce = 44.0, kShortestForce = 5.0, kForcesApart = 14.0, kThinnestElement = 4.0;  // pixels at scale 1
constexpr float kRim = 1.5F, kRimCasing = 3.5F, kActiveCasing = 5.0F, kThinnest = 1.5F, kThickest = 3.5F;
constexpr std::size_t kMostHolders = 2000;

/// The longer the more it holds.
float width_of(const JointCluster& cluster, const JointCluster::Active& one) {
  return kThinnest + (kThickest - kThinnest) * static_cast<float>(std::sqrt(one.multiplier / cluster.active.front().multiplier));
}

/// Of an element across its longest edge, about.
double thickness(const InputMesh& input, std::span<const Vec3> positions, Index element) {
  const auto corners = input.mesh.elements.corners(element);
  const Plane& plane = input.geometry.plane;
  double longest = 0.0, twice_area = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2<double> a = plane.offset(positions[corners[i]], positions[corners[0]]);
    const Vec2<double> b = plane.offset(positions[corners[(i + 1) % corners.size()]], positions[corners[0]]);
    longest = std::max(longest, std::hypot(b.x - a.x, b.y - a.y));
    twice_area += a.x * b.y - a.y * b.x;
  }
  return longest > 0.0 ? 0.5 * std::fabs(twice_area) / longest : 0.0;
}

/// Where forces are drawn: at all of a vertex or at none, so that their balance is seen.
class PlacesOfForces {
 public:
  explicit PlacesOfForces(const render::Bounds2& window, double apart) : taken_(window, apart) {}
  [[nodiscard]] bool take(Index vertex, Vec2<double> at) {
    const auto [known, is_new] = places_.try_emplace(vertex, false);
    if (is_new) known->second = taken_.take(at);
    return known->second;
  }

 private:
  CellsTaken taken_;
  std::map<Index, bool> places_;
};

double longest_force(const JointCluster& cluster) {
  double most = 0.0;
  for (const JointCluster::Force& one : cluster.forces) most = std::max(most, length(one.force));
  return most;
}

/// Edges that one element of the cluster alone has.
std::vector<std::array<Index, 2>> rim_of(const JointCluster& cluster, const InputMesh& input) {
  std::map<std::array<Index, 2>, int> count;
  for (const Index e : elements_of(cluster, input)) {
    const auto corners = input.mesh.elements.corners(e);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Index a = corners[i], b = corners[(i + 1) % corners.size()];
      ++count[{std::min(a, b), std::max(a, b)}];
    }
  }
  std::vector<std::array<Index, 2>> rim;
  for (const auto& [edge, times] : count)
    if (times == 1) rim.push_back(edge);
  return rim;
}

}  // namespace

void add_holders(render::Marks& marks, const MarkView& view, const JointCluster& cluster, const InputMesh& input,
                 std::span<const Vec3> positions, render::Rgba ink, render::Rgba casing) {
  const Plane& plane = input.geometry.plane;
  const auto ends = [&](Index a, Index b) {
    return std::array{plane.place(positions[a]), render::place_near(plane, positions[b], positions[a])};
  };
  CasedLines lines(marks, ink, casing);
  const auto rim = rim_of(cluster, input);
  if (rim.size() <= kMostMarks)
    for (const auto& [a, b] : rim) lines.add(ends(a, b)[0], ends(a, b)[1], kRim, kRimCasing);
  const auto active = holders(cluster).first(std::min(kMostHolders, holders(cluster).size()));
  for (const JointCluster::Active& one : active) {
    const auto corners = input.mesh.elements.corners(one.element);
    if (thickness(input, positions, one.element) < view.units(kThinnestElement)) continue;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto [p, q] = ends(corners[i], corners[(i + 1) % corners.size()]);
      lines.add(p, q, width_of(cluster, one), kActiveCasing);
    }
  }
  const double most = longest_force(cluster), least = view.units(kShortestForce);
  PlacesOfForces places(view.window(), view.units(kForcesApart));
  for (const JointCluster::Force& one : cluster.forces) {
    if (!(most > 0.0)) break;
    const Vec2<double> from = plane.place(positions[one.vertex]), along = plane.project(one.force);
    const double factor = view.units(kLongestForce) / most;
    const Vec2<double> way{factor * along.x, factor * along.y}, tip = from + way;
    const double size = std::hypot(way.x, way.y);
    if (size < least || !places.take(one.vertex, from)) continue;
    const double head = std::min(0.4 * size, view.units(8.0)) / size;
    const Vec2<double> back{-head * way.x, -head * way.y}, side{-0.5 * back.y, 0.5 * back.x};
    lines.add_arrow(from, tip, back, side, 1.5F, 3.5F);
  }
}

void add_space_holders(render::SpaceMarks& marks, const SpaceMarkView& view, const JointCluster& cluster, std::span<const Vec3> positions,
                       render::Rgba ink, render::Rgba casing) {
  for (const JointCluster::Active& one : holders(cluster).first(std::min(kMostHolders, holders(cluster).size())))
    marks.cells.push_back(one.element);
  std::sort(marks.cells.begin(), marks.cells.end());
  const double most = longest_force(cluster);
  if (!(most > 0.0)) return;
  const double unit = view.camera.units_per_pixel(view.projection.viewport());
  CasedLines lines(marks, ink, casing);
  const Vec2<double> half{0.5 * view.projection.viewport().x, 0.5 * view.projection.viewport().y};
  PlacesOfForces places({{-half.x, -half.y}, half}, kForcesApart * view.scale);
  for (const JointCluster::Force& one : cluster.forces) {
    const Vec3 from = positions[one.vertex], way = (kLongestForce * view.scale * unit / most) * one.force, tip = from + way;
    const double pixels = view.pixels(from, tip);
    const auto at = view.projection.place(from);
    if (pixels < kShortestForce * view.scale || !at || !places.take(one.vertex, *at)) continue;
    const Vec3 back = -std::min(0.4, 8.0 * view.scale / pixels) * way;
    lines.add_arrow(from, tip, back, view.across(way, back), 1.5F, 3.5F);
  }
}

}  // namespace dmoscope::ui
