#include "render/draw_order.h"

#include <algorithm>
#include <utility>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/base/radix_sort.h"

namespace dmoscope::render {
namespace {

bool meets(const Bounds2& a, const Bounds2& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

/// Spreads 16 bits to every second bit.
std::uint32_t spread(std::uint32_t v) {
  v = (v | (v << 8U)) & 0x00ff00ffU;
  v = (v | (v << 4U)) & 0x0f0f0f0fU;
  v = (v | (v << 2U)) & 0x33333333U;
  return (v | (v << 1U)) & 0x55555555U;
}

std::vector<Vec2<double>> project(std::span<const Vec3> positions, const Plane& plane) {
  std::vector<Vec2<double>> points(positions.size());
  std::transform(positions.begin(), positions.end(), points.begin(), [&](const Vec3& p) { return plane.place(p); });
  return points;
}

Bounds2 used_bounds(const Mesh& mesh, std::span<const Vec2<double>> points) {
  Bounds2 bounds;
  for (const Index v : mesh.elements.all_corners()) bounds.include(points[v]);
  return bounds;
}

/// An element and its place on a Morton curve through the middles of the elements' first corners; ties are sorted by element, so that the
/// order is the same everywhere.
struct KeyedElement {
  std::uint32_t key;
  Index element;
};
std::vector<KeyedElement> curve_order(const Mesh& mesh, std::span<const Vec2<double>> points, const Bounds2& bounds) {
  const double size = std::max({bounds.size().x, bounds.size().y, 1e-300});
  auto keys = large_vector<KeyedElement>(mesh.elements.size());
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    const auto corners = mesh.elements.corners(e);
    Vec2<double> middle{0, 0};
    for (const Index v : corners) middle = middle + (points[v] - bounds.low);
    const double scale = 65535.0 / size / static_cast<double>(corners.size());
    const auto cell = [&](double v) { return static_cast<std::uint32_t>(std::clamp(v * scale, 0.0, 65535.0)); };
    keys[e] = {spread(cell(middle.x)) | (spread(cell(middle.y)) << 1U), e};
  }
  radix_sort(keys, 32, [](const KeyedElement& item) { return item.key; });
  return keys;
}

/// Edges with one element. Edges are gathered at their lower vertex, where each has only a few companions. `may_end`: one flag a vertex, 0
/// when no such edge ends there; empty: they may end anywhere.
std::vector<std::array<Index, 2>> boundary_edges(const Mesh& mesh, std::span<const std::uint8_t> may_end) {
  const auto ends = [&](Index v) { return may_end.empty() || may_end[v] != 0; };
  const auto for_edges = [&](auto&& visit) {
    for (Index e = 0; e < mesh.elements.size(); ++e) {
      const auto corners = mesh.elements.corners(e);
      Index other = corners.back();
      bool other_ends = ends(other);
      for (const Index corner : corners) {
        const bool this_ends = ends(corner);
        if (this_ends && other_ends && corner != other) visit(std::min(corner, other), std::max(corner, other));
        other = corner;
        other_ends = this_ends;
      }
    }
  };
  std::vector<std::size_t> offsets(std::size_t{mesh.vertex_count()} + 1, 0);
  for_edges([&](Index low, Index) { ++offsets[low + 1]; });
  for (std::size_t v = 1; v < offsets.size(); ++v) offsets[v] += offsets[v - 1];
  std::vector<Index> others(offsets.back());
  std::vector<std::size_t> next(offsets.begin(), offsets.end() - 1);
  for_edges([&](Index low, Index high) { others[next[low]++] = high; });
  std::vector<std::array<Index, 2>> edges;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const auto first = others.begin() + static_cast<std::ptrdiff_t>(offsets[v]);
    const auto last = others.begin() + static_cast<std::ptrdiff_t>(offsets[v + 1]);
    std::sort(first, last);
    for (auto it = first; it != last;) {
      const auto after = std::upper_bound(it, last, *it);
      if (after - it == 1) edges.push_back({v, *it});
      it = after;
    }
  }
  return edges;
}

/// Lists each vertex of a block once, because the block's box needs each only once; as corners they come up six times.
void gather_block_vertices(const Mesh& mesh, Batch& batch) {
  std::vector<Index> last_block(mesh.vertex_count(), kNoIndex);
  batch.block_begins.reserve(std::size_t{batch.block_count()} + 1);
  for (Index b = 0; b < batch.block_count(); ++b) {
    const DrawRange range = batch.block(b);
    for (Index drawn = range.first; drawn < range.last; ++drawn)
      for (const Index v : mesh.elements.corners(batch.order[drawn]))
        if (std::exchange(last_block[v], b) != b) batch.block_vertices.push_back(v);
    batch.block_begins.push_back(batch.block_vertices.size());
  }
  batch.block_vertices.shrink_to_fit();
}

}  // namespace

bool Layout::is_across(std::span<const Index> corners, std::span<const Vec2<double>> points) const noexcept {
  if (!(plane.period > 0.0)) return false;
  double low = points[corners[0]].x, high = low;
  for (const Index v : corners.subspan(1)) low = std::min(low, points[v].x), high = std::max(high, points[v].x);
  return high - low > widest();
}

std::vector<Index> Layout::corners_of(const Batch& batch) const {
  std::vector<Index> corners;
  reserve_large(corners, std::size_t{batch.size()} * batch.corner_count);
  for (const Index element : batch.order) {
    const auto of_element = corners_of(element);
    corners.insert(corners.end(), of_element.begin(), of_element.end());
  }
  return corners;
}

std::shared_ptr<const Layout> build_layout(std::shared_ptr<const Mesh> of, const Plane& plane, std::span<const std::uint8_t> boundary) {
  const Mesh& mesh = *of;
  for (const ElementKind kind : mesh.elements.kinds()) {
    if (info(kind).dimension != 2)
      throw UsageError(std::string("only triangles and quadrilaterals can be drawn, not ") + std::string(info(kind).plural));
  }
  auto layout = std::make_shared<Layout>();
  layout->mesh = std::move(of);
  layout->plane = plane;
  layout->vertex_count = mesh.vertex_count();
  const std::vector<Vec2<double>> points = project(mesh.positions, plane);
  const Bounds2 bounds = used_bounds(mesh, points);
  layout->origin = bounds.empty() ? Vec2<double>{0, 0} : bounds.centre();
  layout->slots.resize(mesh.elements.size());
  layout->batches[1].corner_count = 4;
  const auto keys = curve_order(mesh, points, bounds);
  std::array<std::size_t, 2> counts{};
  for (const ElementKind kind : mesh.elements.kinds()) ++counts[kind == ElementKind::Triangle ? 0 : 1];
  for (std::size_t i = 0; i < counts.size(); ++i) reserve_large(layout->batches[i].order, counts[i]);
  for (const auto& [key, element] : keys) {
    Batch& batch = layout->batches[mesh.elements.kind(element) == ElementKind::Triangle ? 0 : 1];
    layout->slots[element] = batch.size();
    batch.order.push_back(element);
  }
  for (const Index element : layout->batches[1].order) layout->slots[element] += layout->batches[0].size();
  for (Batch& batch : layout->batches)
    if (batch.size() > 0) gather_block_vertices(mesh, batch);
  layout->boundary_edges = boundary_edges(mesh, boundary);
  return layout;
}

Placement::Placement(std::shared_ptr<const Layout> layout) : layout_(std::move(layout)), points_(layout_->vertex_count) {
  for (std::size_t i = 0; i < block_bounds_.size(); ++i) block_bounds_[i].resize(layout_->batches[i].block_count());
}

void Placement::move(std::span<const Vec3> positions) {
  if (positions.size() != points_.size()) throw UsageError("as many positions as the mesh has vertices are needed");
  std::transform(positions.begin(), positions.end(), points_.begin(), [&](const Vec3& p) { return layout_->plane.place(p); });
  fit_boxes();
}

void Placement::move(std::span<const Vec2<float>> points) {
  if (points.size() != points_.size()) throw UsageError("as many points as the mesh has vertices are needed");
  std::transform(points.begin(), points.end(), points_.begin(), [&](const Vec2<float>& p) {
    return layout_->origin + Vec2<double>{static_cast<double>(p.x), static_cast<double>(p.y)};
  });
  fit_boxes();
}

void Placement::fit_boxes() {
  bounds_ = {};
  for (std::size_t i = 0; i < block_bounds_.size(); ++i) {
    const Batch& batch = layout_->batches[i];
    for (Index b = 0; b < batch.block_count(); ++b) {
      const std::span<const Index> vertices = batch.vertices_of_block(b);
      Vec2<double> low = points_[vertices.front()], high = low;
      for (const Index v : vertices) {
        const Vec2<double> p = points_[v];
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
      }
      block_bounds_[i][b] = {low, high};
      bounds_.include(block_bounds_[i][b]);
    }
  }
}

std::vector<DrawRange> Placement::visible(std::size_t batch, const Bounds2& window) const {
  std::vector<DrawRange> ranges;
  const Batch& elements = layout_->batches[batch];
  for (Index b = 0; b < elements.block_count(); ++b) {
    if (!meets(block_bounds_[batch][b], window)) continue;
    const DrawRange range = elements.block(b);
    if (!ranges.empty() && ranges.back().last == range.first) {
      ranges.back().last = range.last;
    } else {
      ranges.push_back(range);
    }
  }
  return ranges;
}

bool contains(std::span<const Index> corners, std::span<const Vec2<double>> points, Vec2<double> point) {
  int winding = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2<double> a = points[corners[i]] - point, b = points[corners[(i + 1) % corners.size()]] - point;
    const double side = cross(a, b);
    if (side == 0.0 && dot(a, b) <= 0.0) return true;
    if (a.y <= 0.0 && b.y > 0.0 && side > 0.0) ++winding;
    if (a.y > 0.0 && b.y <= 0.0 && side < 0.0) --winding;
  }
  return winding != 0;
}

}  // namespace dmoscope::render
