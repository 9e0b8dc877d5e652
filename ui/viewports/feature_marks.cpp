#include <algorithm>

#include "ui/viewports/mesh_marks.h"

namespace dmoscope::ui {
namespace {

constexpr float kLine = 2.0F, kCasing = 4.5F, kSquare = 7.0F, kFound = 4.0F, kFoundCasing = 7.5F;  // pixels at scale 1

}  // namespace

void add_features(render::Marks& marks, const MarkView& view, const Domain& domain, const InputMesh& input, std::span<const Vec3> positions,
                  render::Rgba ink) {
  const Plane& plane = input.geometry.plane;
  const render::Bounds2 window = view.window();
  const auto inside = [&](Vec2<double> p) {
    return p.x >= window.low.x && p.x <= window.high.x && p.y >= window.low.y && p.y <= window.high.y;
  };
  for (const auto& [a, b] : domain.feature_edges()) {
    const Vec2<double> from = plane.place(positions[a]), to = plane.place(positions[b]);
    if (inside(from) || inside(to)) marks.lines.push_back({from, to, kLine, ink});
    for (const Index v : {a, b})
      if (domain.is_held(v) && inside(plane.place(positions[v])))
        marks.dots.push_back({plane.place(positions[v]), kSquare, ink, render::DotShape::Square});
  }
}

void add_space_features(render::SpaceMarks& marks, const Domain& domain, std::span<const Vec3> positions, const render::Unhidden& unhidden,
                        render::Rgba ink, render::Rgba casing) {
  const auto features = domain.feature_edges();
  std::vector<std::array<Index, 2>> seen;
  for (auto [a, b] : unhidden.edges) {
    if (a > b) std::swap(a, b);
    if (std::ranges::binary_search(features, std::array{a, b})) seen.push_back({a, b});
  }
  for (const auto& [a, b] : seen) marks.lines.push_back({positions[a], positions[b], kCasing, casing});
  for (const auto& [a, b] : seen) marks.lines.push_back({positions[a], positions[b], kLine, ink});
  for (const Index v : unhidden.vertices)
    if (domain.is_held(v)) marks.dots.push_back({positions[v], kSquare, ink, render::DotShape::Square});
}

void add_edge(render::Marks& marks, const InputMesh& input, std::span<const Vec3> positions, const EdgeEnds& edge, render::Rgba ink,
              render::Rgba casing) {
  const Plane& plane = input.geometry.plane;
  const Vec2<double> from = plane.place(positions[edge[0]]), to = plane.place(positions[edge[1]]);
  marks.lines.push_back({from, to, kFoundCasing, casing});
  marks.lines.push_back({from, to, kFound, ink});
}

void add_space_edge(render::SpaceMarks& marks, std::span<const Vec3> positions, const EdgeEnds& edge, render::Rgba ink,
                    render::Rgba casing) {
  marks.lines.push_back({positions[edge[0]], positions[edge[1]], kFoundCasing, casing});
  marks.lines.push_back({positions[edge[0]], positions[edge[1]], kFound, ink});
}

}  // namespace dmoscope::ui
