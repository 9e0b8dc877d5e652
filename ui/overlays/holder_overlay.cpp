#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "core/inspect/joint_hold.h"
#include "core/mesh/element_edges.h"
#include "ui/analysis/run_colours.h"
#include "ui/overlays/moves.h"
#include "ui/overlays/overlay.h"

namespace dmoscope::ui {
namespace {

constexpr double kLongestForce = 44.0, kShortestForce = 5.0, kForcesApart = 14.0, kThinnestElement = 4.0;  // pixels at scale 1
constexpr float kRim = 1.5F, kRimCasing = 3.5F, kActiveCasing = 5.0F, kThinnest = 1.5F, kThickest = 3.5F;
constexpr std::size_t kMostHolders = 2000;

/// Width of the lines of an element: the more it holds, the wider.
float width_of(const JointCluster& cluster, const JointCluster::Active& one) {
  return kThinnest + (kThickest - kThinnest) * static_cast<float>(std::sqrt(one.multiplier / cluster.active.front().multiplier));
}

/// Approximate thickness of a flat element, across its longest edge.
double thickness(const ScenePoints& points, const InputMesh& input, std::span<const Vec3> positions, Index element) {
  const auto corners = input.mesh.elements.corners(element);
  double longest = 0.0;
  Vec3 twice_area{};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 a = points.way(positions[corners[i]], positions[corners[0]]);
    const Vec3 b = points.way(positions[corners[(i + 1) % corners.size()]], positions[corners[0]]);
    longest = std::max(longest, length(b - a));
    twice_area = twice_area + cross(a, b);
  }
  return longest > 0.0 ? 0.5 * length(twice_area) / longest : 0.0;
}

double longest_force(const JointCluster& cluster) {
  double most = 0.0;
  for (const JointCluster::Force& one : cluster.forces) most = std::max(most, length(one.force));
  return most;
}

/// Edges that belong to only one element of the cluster.
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

void add_forces(render::Marks& marks, const MarkView& view, const JointCluster& cluster, std::span<const Vec3> positions, Inks inks) {
  const double most = longest_force(cluster);
  if (!(most > 0.0)) return;
  CasedLines lines(marks, inks);
  PlacesTaken taken(view, kForcesApart);
  std::map<Index, bool> has_room;  // all forces on a vertex are drawn or none, so that their balance is seen
  for (const JointCluster::Force& one : cluster.forces) {
    const Vec3 from = view.points.at(positions[one.vertex]), way = (view.units(kLongestForce) / most) * view.points.along(one.force);
    if (view.pixels(from, from + way) < kShortestForce) continue;
    const auto [known, is_new] = has_room.try_emplace(one.vertex, false);
    if (is_new) known->second = taken.take(from);
    if (known->second) add_arrow(lines, view, from, way, 8.0, 1.5F, 3.5F);
  }
}

/// Adds the rim of the cluster, the elements that hold one another, and their forces; nothing hides them. A cluster of a volume has no rim.
void add_holders(render::Marks& marks, const MarkView& view, const JointCluster& cluster, const InputMesh& input,
                 std::span<const Vec3> positions, Inks inks) {
  {
    CasedLines lines(marks, inks);
    const auto add = [&](Index a, Index b, float width, float casing) {
      lines.add(view.points.at(positions[a]), view.points.at(positions[b], positions[a]), width, casing);
    };
    const auto rim = input.is_volume() ? std::vector<EdgeEnds>{} : rim_of(cluster, input);
    if (rim.size() <= kMostMarks)
      for (const auto& [a, b] : rim) add(a, b, kRim, kRimCasing);
    for (const JointCluster::Active& one : holders(cluster).first(std::min(kMostHolders, holders(cluster).size()))) {
      if (input.is_volume()) {  // no width could be seen between so many edges
        marks.elements.push_back(one.element);
      } else if (thickness(view.points, input, positions, one.element) >= view.units(kThinnestElement)) {
        for_edges(input.mesh.elements, one.element, [&](Index a, Index b) { add(a, b, width_of(cluster, one), kActiveCasing); });
      }
    }
  }
  add_forces(marks, view, cluster, positions, inks);
}

class HolderOverlay final : public Overlay {
 public:
  [[nodiscard]] bool wanted(const OverlayInput& in) const override { return hold_of(in) != nullptr; }
  void make(const OverlayInput& in, const MarkView& view, render::Marks& marks) override {
    add_holders(marks, view, *hold_of(in), in.input(), in.frame().positions, in.inks(220));
  }
  [[nodiscard]] bool needs_unhidden() const override { return false; }
  [[nodiscard]] std::string note(const OverlayInput& in) const override {
    if (!in.state.holders) return {};
    const auto hold = hold_of(in);
    if (hold == nullptr) return "what holds the minimum is not known here";
    return fmt::format("{} elements hold one another{}", holders(*hold).size(), hold->certified ? "" : " (not certified)");
  }
};

}  // namespace

std::shared_ptr<const JointCluster> hold_of(const OverlayInput& in) {
  const RunView* run = in.run();
  return in.state.holders && run != nullptr && in.frame().moment == run->moment ? run->hold() : nullptr;
}

OverlayPointer holder_overlay() { return std::make_unique<HolderOverlay>(); }

}  // namespace dmoscope::ui
