#include "ui/analysis/facts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/error.h"
#include "core/inspect/target_shape.h"
#include "core/mesh/faces.h"
#include "core/mesh/geographic.h"
#include "core/view/patch.h"

namespace dmoscope::ui {
namespace {

void read_vertex(PickedFacts& facts, const Frame& frame, Index vertex) {
  std::vector<Index> elements;
  for (const Incidence& incidence : frame.input->topology.star(vertex)) elements.push_back(incidence.element);
  const Patch patch = patch_of(frame, elements);
  const auto own = std::ranges::lower_bound(patch.vertices, vertex);
  facts.at = own != patch.vertices.end() && *own == vertex ? patch.mesh.positions[static_cast<std::size_t>(own - patch.vertices.begin())]
                                                           : positions_of(frame, {&vertex, 1}).front();
  facts.at = place_in_file(frame.input->mesh, vertex, facts.at);
  facts.now = facts.before = std::numeric_limits<double>::infinity();
  const InputMesh& input = *frame.input;
  for (Index k = 0; k < elements.size(); ++k) {
    const double now = patch.quality(frame.shown, k);
    facts.star.push_back({elements[k], now, patch.inverted(k)});
    facts.now = std::min(facts.now, now);
    facts.before = std::min(facts.before, element_quality(input.quality_context(), input.mesh.positions, frame.shown, elements[k]));
  }
}

void include(AngleSpan& span, double radians) {
  const double degrees = radians * 180.0 / std::numbers::pi;
  span = {std::min(span.smallest, degrees), std::max(span.largest, degrees)};
}

/// Least and greatest angle at the corners of a planar element, which are in order. None: it has not three different ones.
std::optional<AngleSpan> angles_between(const Frame& frame, std::span<const Index> corners) {
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < corners.size(); ++i)  // a corner that appears twice counts once
    if (corners[i] != corners[(i + 1) % corners.size()]) places.push_back(frame.positions[corners[i]]);
  const std::size_t n = places.size();
  if (n < 3) return std::nullopt;
  const Plane& plane = frame.input->geometry.plane;
  AngleSpan span{180.0, 0.0};
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 out = plane.difference(places[(i + 1) % n], places[i]), in = plane.difference(places[(i + n - 1) % n], places[i]);
    include(span, std::atan2(length(cross(out, in)), dot(out, in)));
  }
  return span;
}

/// Least and greatest angle between two faces of a volume element that share an edge, each as flat as it is on average.
AngleSpan angles_between(const Frame& frame, std::span<const Index> corners, std::span<const LocalFace> faces) {
  const auto normal = [&](const LocalFace& face) {
    const auto edge = [&](Index i) { return frame.positions[corners[face.corners[i]]] - frame.positions[corners[face.corners[0]]]; };
    return face.count == 3 ? cross(edge(1), edge(2)) : cross(edge(1), edge(2)) + cross(edge(2), edge(3));
  };
  const auto shared = [](const LocalFace& a, const LocalFace& b) {
    return std::ranges::count_if(a.span(), [&](Index corner) { return std::ranges::count(b.span(), corner) > 0; });
  };
  AngleSpan span{180.0, 0.0};
  for (const LocalFace& a : faces)
    for (const LocalFace& b : faces)
      if (&a < &b && shared(a, b) == 2) {
        const Vec3 n = normal(a), m = normal(b);
        include(span, std::numbers::pi - std::atan2(length(cross(n, m)), dot(n, m)));
      }
  return span;
}

void read_element(PickedFacts& facts, const Frame& frame, Index element) {
  const Patch patch = patch_of(frame, {&element, 1});
  const InputMesh& input = *frame.input;
  facts.inverted = patch.inverted(0);
  facts.inverted_inside = patch.inverted_inside(0);
  if (!facts.inverted) facts.angles = angles_of(frame, element);
  const auto add = [&](const MetricInfo& metric) {
    facts.metrics.push_back(
        {&metric, patch.quality(metric.metric, 0), element_quality(input.quality_context(), input.mesh.positions, metric.metric, element)});
  };
  for (const MetricInfo& metric : metric_table())
    if (metric.metric == frame.shown || metric.defined_for(input.mesh.elements.kind(element))) add(metric);
  if (is_built_in(frame.shown)) return;
  add(info(frame.shown));
  if (frame.positions.empty()) return;
  if (const auto shape = target_shape(input, frame.positions, frame.shown, element)) {
    facts.aspect = TargetShapeOfElement::aspect(shape->now);
    facts.target_aspect = TargetShapeOfElement::aspect(shape->wished);
  }
}

}  // namespace

std::optional<AngleSpan> angles_of(const Frame& frame, Index element) {
  const ElementTable& elements = frame.input->mesh.elements;
  if (frame.positions.empty() || element >= elements.size()) return std::nullopt;
  const auto corners = elements.corners(element);
  const auto faces = faces_of(elements.kind(element));
  return faces.size() > 1 ? angles_between(frame, corners, faces) : angles_between(frame, corners);
}

PickedFacts facts_of(const Frame& frame, const Picked& picked) {
  PickedFacts facts;
  try {
    if (picked.kind == Picked::Kind::Vertex && picked.id < frame.vertex_count()) {
      read_vertex(facts, frame, picked.id);
      facts.picked = picked;
    } else if (picked.kind == Picked::Kind::Element && picked.id < frame.element_count()) {
      read_element(facts, frame, picked.id);
      facts.picked = picked;
    }
  } catch (const Error& error) {
    facts = {};
    facts.trouble = error.what();
  }
  return facts;
}

}  // namespace dmoscope::ui
