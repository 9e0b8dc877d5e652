#include "ui/state/view_geometry.h"

#include <algorithm>
#include <array>

#include "core/view/patch.h"
#include "render/draw_order.h"
#include "ui/state/format.h"

namespace dmoscope::ui {

namespace {

render::Bounds2 box_of(const Frame& frame, std::span<const Index> vertices) {
  render::Bounds2 box;
  const Plane& plane = frame.input->geometry.plane;
  const std::vector<Vec3> positions = positions_of(frame, vertices);
  for (const Vec3& position : positions) box.include(render::place_near(plane, position, positions[0]));
  return box;
}

/// Vector perpendicular to an element of a surface, as long as twice its area.
Vec3 area_vector(const Frame& frame, Index element) {
  const auto c = frame.input->mesh.elements.corners(element);
  Vec3 sum;
  for (std::size_t i = 2; i < c.size(); ++i)
    sum = sum + cross(frame.positions[c[i - 1]] - frame.positions[c[0]], frame.positions[c[i]] - frame.positions[c[0]]);
  return sum;
}

/// Direction in which a surface faces at some elements: outward if it is closed, else by their orientation.
Vec3 outward(const Frame& frame, std::span<const Index> elements) {
  const Mesh& mesh = frame.input->mesh;
  Vec3 sum;
  for (const Index e : elements) sum = sum + area_vector(frame, e);
  if (std::ranges::count(frame.input->topology.boundary(), 0) < std::ssize(frame.input->topology.boundary())) return sum;
  double volume = 0.0;
  const Vec3 origin = frame.positions[mesh.elements.corners(0)[0]];
  for (Index e = 0; e < mesh.elements.size(); ++e)
    volume += dot(frame.positions[mesh.elements.corners(e)[0]] - origin, area_vector(frame, e));
  return volume < 0.0 ? -1.0 * sum : sum;
}

/// Share of a mesh's faces, by area, that are at its lowest end along an axis and face that way.
double share_of_base(const InputMesh& input, double Vec3::*axis) {
  constexpr double kNear = 0.01, kFlat = 0.98;  // share of the extent; cosine
  const std::vector<Vec3>& at = input.mesh.positions;
  const auto [low, high] = std::ranges::minmax(at, {}, axis);
  const double below = low.*axis + kNear * (high.*axis - low.*axis);
  double base = 0.0, all = 0.0;
  const auto add = [&](ElementFace face) {
    const auto corners = vertices_of(input.mesh.elements, face);
    Vec3 area;
    bool at_end = true;
    for (std::size_t i = 0; i < corners.size() && corners[i] != kNoIndex; ++i) {
      if (i >= 2) area = area + cross(at[corners[i - 1]] - at[corners[0]], at[corners[i]] - at[corners[0]]);
      at_end = at_end && at[corners[i]].*axis <= below;
    }
    all += length(area);
    if (at_end && std::abs(area.*axis) >= kFlat * length(area)) base += length(area);
  };
  std::ranges::for_each(input.faces.boundary(), add);
  if (!input.is_volume())
    for (Index e = 0; e < input.mesh.elements.size(); ++e) add({e, 0});
  return all > 0.0 ? base / all : 0.0;
}

/// Position of a vertex in coordinates of the mesh's plane. Throws DeviceError.
Vec2<double> plane_point(const Frame& frame, Index vertex) {
  return frame.input->geometry.plane.place(positions_of(frame, {&vertex, 1}).front());
}

}  // namespace

render::UpAxis guessed_up(const InputMesh& input) {
  constexpr double kBase = 0.02;  // share of the area
  if (!input.in_space() || input.mesh.positions.empty() || share_of_base(input, &Vec3::z) >= kBase) return render::UpAxis::Z;
  const bool is_obj = lower_case(input.path.extension().string()) == ".obj";
  return is_obj || share_of_base(input, &Vec3::y) >= kBase ? render::UpAxis::Y : render::UpAxis::Z;
}

render::Bounds2 element_box(const Frame& frame, Index element) { return box_of(frame, frame.input->mesh.elements.corners(element)); }

render::Bounds2 star_box(const Frame& frame, Index vertex) {
  std::vector<Index> vertices{vertex};
  for (const Incidence& incidence : frame.input->topology.star(vertex)) {
    const auto corners = frame.input->mesh.elements.corners(incidence.element);
    vertices.insert(vertices.end(), corners.begin(), corners.end());
  }
  return box_of(frame, vertices);
}

void look_at_picked(ViewState& state, const Frame& frame) {
  // About a tenth of the view's side: the picked element can be read, and its neighbourhood is seen.
  constexpr double kSurroundings = 6.0;
  const Picked& picked = state.picked;
  if (picked.kind == Picked::Kind::None) return;
  const bool vertex = picked.kind == Picked::Kind::Vertex;
  if (frame.input->in_space()) {
    render::Bounds3 box;
    std::vector<Index> around{picked.id};
    if (vertex) {
      around.clear();
      for (const Incidence& incidence : frame.input->topology.star(picked.id)) around.push_back(incidence.element);
    }
    if (frame.input->is_surface()) state.orbit.face(outward(frame, around));
    const auto include = [&](Index element) {
      for (const Index v : frame.input->mesh.elements.corners(element)) box.include(frame.positions[v]);
    };
    for (const Index element : around) include(element);
    state.orbit.orbit_about(vertex ? frame.positions[picked.id] : box.centre());
    state.orbit.height = kSurroundings * std::max(box.radius(), 1e-9 * frame.input->geometry.size);
    return;
  }
  const render::Bounds2 box = vertex ? star_box(frame, picked.id) : element_box(frame, picked.id);
  const double extent = std::max({box.size().x, box.size().y, 1e-9 * frame.input->geometry.size});
  state.camera.look_at(vertex ? plane_point(frame, picked.id) : box.centre(), (vertex ? 0.5 : 1.0) * kSurroundings * extent,
                       state.viewport);
}

std::vector<Metric> usable_metrics(const Mesh& mesh) {
  std::array<bool, kElementKindCount> present{};
  for (const ElementKind kind : mesh.elements.kinds()) present[static_cast<std::size_t>(kind)] = true;
  std::vector<Metric> metrics;
  for (const MetricInfo& metric : metric_table()) {
    bool defined = true;
    for (std::size_t kind = 0; kind < kElementKindCount; ++kind) {
      defined = defined && (!present[kind] || metric.defined_for(static_cast<ElementKind>(kind)));
    }
    if (defined) metrics.push_back(metric.metric);
  }
  return metrics;
}

}  // namespace dmoscope::ui
