#include "core/reference/planar_ends.h"

#include "core/mesh/edges.h"
#include "core/reference/hold.h"

namespace dmoscope {

namespace {

/// Holds vertices where interfaces meet the boundary, and vertices of a named line that slide, but not along it.
void hold_at_interfaces(const InputMesh& input, NamedEdges& names, CurveEnds& ends) {
  for (Index v = 0; v < ends.size(); ++v)
    if (input.interfaces.meets_boundary_at(v)) ends.hold(v, HeldOn::Rule);
  names.for_lines([&ends](Index a, Index b) {
    if (ends.slides(a) && ends.of(a)[0] != b && ends.of(a)[1] != b) ends.hold(a, HeldOn::Named);
    if (ends.slides(b) && ends.of(b)[0] != a && ends.of(b)[1] != a) ends.hold(b, HeldOn::Named);
  });
}

}  // namespace

CurveEnds planar_ends(const InputMesh& input, const StandingRule& rule) {
  CurveEnds ends(input.mesh.vertex_count());
  const bool boundary = rule.boundary == BoundaryRule::Slide, interfaces = rule.interfaces == InterfaceRule::Slide;
  for_each_edge(input.mesh, input.topology, [&](const Edge& edge, std::span<const EdgeSide> sides) {
    if (sides.size() > 2) return ends.hold(edge.low, HeldOn::Touching), ends.hold(edge.high, HeldOn::Touching);
    const bool along = sides.size() == 1 ? boundary : interfaces && input.interfaces.between(sides[0].element, sides[1].element);
    const bool said = !along && sides.size() == 2 && rule.kinds.has_feature({edge.low, edge.high});
    if (along || said) ends.join(edge.low, edge.high);
    if (!said || rule.interfaces == InterfaceRule::Free) return;
    for (const Index v : {edge.low, edge.high})
      if (input.interfaces.holds(v)) ends.hold(v, HeldOn::Rule);
  });
  for (Index v = 0; v < ends.size() && !boundary; ++v)
    if (input.topology.boundary()[v] != 0) ends.hold(v, HeldOn::Rule);
  for (const Index v : rule.kinds.corners)
    if (!ends.off(v)) ends.hold(v, HeldOn::Hand);
  hold_corners(input, rule, ends);
  NamedEdges names(input.mesh, input.topology);
  hold_ends_of_names(names, ends);
  hold_tied(input, ends);
  hold_named_points(input, ends);
  if (rule.interfaces != InterfaceRule::Free) hold_at_interfaces(input, names, ends);
  hold_parting(input, {}, ends);
  return ends;
}

}  // namespace dmoscope
