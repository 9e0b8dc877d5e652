#include "core/reference/hold.h"

#include <cmath>
#include <numeric>
#include <vector>

namespace dmoscope {

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

void hold_parting(const InputMesh& input, CurveEnds& ends) {
  const std::vector<Partners> pairs = partners_of(input);
  if (pairs.empty()) return;
  std::vector<Index> image(ends.size());
  std::iota(image.begin(), image.end(), Index{0});
  for (const Partners& pair : pairs) image[pair.first] = pair.second;
  for (const auto& [first, second, shift] : pairs) {
    const bool both = ends.slides(first) && ends.slides(second);
    if (both) {
      // Compares both ends in either order, and a vertex that both curves share with itself.
      const auto stands_for = [&](Index of_first, Index of_second) { return image[of_first] == of_second || image[of_second] == of_first; };
      const auto [a, b] = ends.of(first);
      const auto [c, d] = ends.of(second);
      if ((stands_for(a, c) && stands_for(b, d)) || (stands_for(a, d) && stands_for(b, c))) continue;
    }
    for (const Index v : {first, second})
      if (ends.slides(v)) ends.hold(v, HeldOn::Tied);
  }
}

std::vector<Partners> partners_of(const InputMesh& input) {
  if (input.is_volume() || input.surface || input.share) return {};
  return find_partners(input.mesh, input.topology);
}

}  // namespace dmoscope
