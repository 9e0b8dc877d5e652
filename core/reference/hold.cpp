#include "core/reference/hold.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace dmoscope {

namespace {

/// Whether both of a pair slide between neighbours that stand for each other, moved alike.
class PartnerNeighbours {
 public:
  /// `faces`: on which vertices off curves slide.
  PartnerNeighbours(const InputMesh& input, const ElementTable& faces, const CurveEnds& ends)
      : input_(input), ends_(ends), ties_(find_partners(input.mesh, input.topology)), around_(ends.size()) {
    for (const Partners& pair : std::vector(ties_)) ties_.push_back({pair.second, pair.first, -1.0 * pair.shift});
    std::ranges::sort(ties_, {}, both_of);
    for (const Partners& tie : ties_) around_[tie.first].push_back(tie.first);  // as a sign that it is looked at
    for (Index f = 0; f < faces.size(); ++f)
      for (const Index v : faces.corners(f))
        if (!around_[v].empty()) around_[v].insert(around_[v].end(), faces.corners(f).begin(), faces.corners(f).end());
    for (std::vector<Index>& around : around_) {
      std::ranges::sort(around);
      around.erase(std::unique(around.begin(), around.end()), around.end());
    }
  }

  [[nodiscard]] bool move_alike(const Partners& pair) const {
    const auto on_faces = [this](Index v) { return ends_.off(v) && around_[v].size() > 1; };
    const bool along_curves = ends_.slides(pair.first) && ends_.slides(pair.second);
    if (!along_curves && !(on_faces(pair.first) && on_faces(pair.second))) return false;
    const std::span<const Index> of_first = around(pair.first), of_second = around(pair.second);
    return of_first.size() == of_second.size() && std::ranges::all_of(of_first, [&](Index a) {
             return std::ranges::any_of(of_second, [&](Index b) { return stands_for(a, b, pair.shift); });
           });
  }

 private:
  static std::pair<Index, Index> both_of(const Partners& pair) { return {pair.first, pair.second}; }
  [[nodiscard]] std::span<const Index> around(Index v) const { return ends_.slides(v) ? std::span<const Index>(ends_.of(v)) : around_[v]; }
  /// A curve may begin at either end, and at a vertex that both have in common.
  [[nodiscard]] bool stands_for(Index a, Index b, Vec3 shift) const {
    constexpr double kRounding = 1e-8;  // of the mesh's size: digits that a file leaves out
    if (a == b) return shift == Vec3{};
    if (!std::ranges::binary_search(ties_, std::pair(a, b), {}, both_of)) return false;
    const Vec3 apart = input_.mesh.positions[b] - input_.mesh.positions[a] - shift;
    return length(apart) <= kRounding * input_.geometry.size;
  }

  const InputMesh& input_;
  const CurveEnds& ends_;
  std::vector<Partners> ties_;              // both ways, ascending
  std::vector<std::vector<Index>> around_;  // by vertex that is tied: itself, and the other corners of its faces
};

}  // namespace

void hold_corners(const InputMesh& input, const StandingRule& rule, CurveEnds& ends) {
  const Plane& plane = input.geometry.plane;
  for (Index v = 0; v < ends.size(); ++v) {
    if (!ends.slides(v)) continue;
    const Vec3 here = input.mesh.positions[v];
    const Vec3 in = plane.difference(here, input.mesh.positions[ends.of(v)[0]]);
    const Vec3 out = plane.difference(input.mesh.positions[ends.of(v)[1]], here);
    const double turn = std::atan2(length(cross(in, out)), dot(in, out));
    const bool has_direction = dot(in, in) > 0.0 && dot(out, out) > 0.0;
    const bool turns = !(turn <= rule.corner_angle * kDegree) && !rule.kinds.has_no_corner(v);
    if (!has_direction || turns) ends.hold(v, HeldOn::Corner);
  }
}

void hold_ends_of_names(const NamedEdges& names, CurveEnds& ends) {
  for (Index v = 0; v < ends.size(); ++v)
    if (ends.slides(v) && !names.same(v, ends.of(v)[0], ends.of(v)[1])) ends.hold(v, HeldOn::Named);
}

void hold_named_points(const InputMesh& input, CurveEnds& ends) {
  const Mesh& mesh = input.mesh;
  std::vector<const Group*> points;
  for (const Group& group : mesh.groups) {
    if (group.dimension == 0 && !is_string(group)) points.push_back(&group);
    if (group.dimension != 2 || !is_required(group)) continue;
    for (const Index v : group.faces.all_corners()) ends.hold(v, HeldOn::Named);
    if (!group.of_elements()) continue;
    for (const Index e : group.members)
      for (const Index v : mesh.elements.corners(e)) ends.hold(v, HeldOn::Named);
  }
  if (points.empty()) return;
  NamedList list(NamedKind::Points, points, mesh, input.topology);
  for (const Group* group : points)
    for (const Index v : group->members)
      if (is_required(*group) || !list.surrounds(v)) ends.hold(v, HeldOn::Named);
}

void hold_tied(const InputMesh& input, CurveEnds& ends) {
  std::vector<Tie> ties = find_ties(input.mesh, input.topology, input.faces);
  for (const Partners& pair : partners_of(input)) ties[pair.first] = ties[pair.second] = Tie::None;
  for (Index v = 0; v < ends.size(); ++v)
    if (ties[v] != Tie::None) ends.hold(v, HeldOn::Tied);
}

void hold_parting(const InputMesh& input, const ElementTable& faces, CurveEnds& ends) {
  const std::vector<Partners> pairs = partners_of(input);
  if (pairs.empty()) return;
  const PartnerNeighbours neighbours(input, faces, ends);
  for (const Partners& pair : pairs) {
    if (neighbours.move_alike(pair)) continue;
    for (const Index v : {pair.first, pair.second})
      if (ends.slides(v) || ends.off(v)) ends.hold(v, HeldOn::Tied);
  }
}

std::vector<Partners> partners_of(const InputMesh& input) {
  if (input.surface || input.share) return {};
  std::vector<Partners> pairs = find_partners(input.mesh, input.topology);
  std::vector<Index> ties(input.mesh.vertex_count(), 0);  // by vertex: to how many others
  for (const Partners& pair : pairs) ++ties[pair.first], ++ties[pair.second];
  const bool is_cyclic = input.geometry.plane.period > 0.0;
  std::erase_if(
      pairs, [&](const Partners& pair) { return ties[pair.first] > 1 || ties[pair.second] > 1 || (is_cyclic && !(pair.shift == Vec3{})); });
  return pairs;
}

}  // namespace dmoscope
