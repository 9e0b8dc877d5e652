#pragma once
// A mesh in drawing order: neighbours together, in blocks that can be left out as a whole. No OpenGL.

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "core/base/vec.h"
#include "core/mesh/mesh.h"
#include "core/mesh/plane.h"
#include "render/camera.h"

namespace dmoscope::render {

/// Drawn elements [first, last) of a batch.
struct DrawRange {
  Index first = 0, last = 0;
};

/// All elements of one kind, in drawing order (along a Morton curve over the positions the mesh came with).
struct Batch {
  static constexpr Index kBlock = 1024;  // elements per block; the last has fewer
  Index corner_count = 3;
  std::vector<Index> order;                  // element of each drawn index
  std::vector<Index> block_vertices;         // the corners of each block's elements, every vertex once a block
  std::vector<std::size_t> block_begins{0};  // begin of each block's vertices, and the end of the last
  [[nodiscard]] Index size() const noexcept { return static_cast<Index>(order.size()); }
  [[nodiscard]] Index block_count() const noexcept { return (size() + kBlock - 1) / kBlock; }
  [[nodiscard]] std::span<const Index> vertices_of_block(Index b) const noexcept {
    return std::span(block_vertices).subspan(block_begins[b], block_begins[b + 1] - block_begins[b]);
  }
  [[nodiscard]] DrawRange block(Index b) const noexcept { return {b * kBlock, std::min(size(), (b + 1) * kBlock)}; }
};

/// Place in the picture of a position that belongs to one at `other`: in a mesh that wraps they stay together, if need be beyond the
/// picture's end.
[[nodiscard]] inline Vec2<double> place_near(const Plane& plane, Vec3 position, Vec3 other) {
  return plane.period > 0.0 ? plane.place(other) + plane.offset(position, other) : plane.place(position);
}

struct Layout {
  std::shared_ptr<const Mesh> mesh;  // the mesh whose elements these are
  Plane plane;
  Vec2<double> origin;  // middle of the bounding box at build; positions on the OpenGL side are relative to it
  Index vertex_count = 0;
  std::array<Batch, 2> batches;                      // triangles, quadrilaterals
  std::vector<Index> slots;                          // drawn index of each element; quadrilaterals count on after the last triangle
  std::vector<std::array<Index, 2>> boundary_edges;  // edges with exactly one element

  [[nodiscard]] Index element_count() const noexcept { return static_cast<Index>(slots.size()); }
  /// Greatest width of a drawn element. A wider one lies across the seam of a mesh that wraps, from one end of the picture to the other,
  /// and is left out.
  [[nodiscard]] double widest() const noexcept { return plane.period > 0.0 ? 0.5 * plane.period : std::numeric_limits<double>::infinity(); }
  [[nodiscard]] bool is_across(std::span<const Index> corners, std::span<const Vec2<double>> points) const noexcept;
  [[nodiscard]] std::span<const Index> corners_of(Index element) const { return mesh->elements.corners(element); }
  /// Corners of all drawn elements of a batch, one after another, as OpenGL takes them.
  [[nodiscard]] std::vector<Index> corners_of(const Batch& batch) const;
};

/// Builds the layout; about 0.1 s per million elements, on any thread. `boundary`: see Topology::boundary; empty when not known. Throws
/// UsageError when an element is not a triangle or a quadrilateral.
[[nodiscard]] std::shared_ptr<const Layout> build_layout(std::shared_ptr<const Mesh> of, const Plane& plane,
                                                         std::span<const std::uint8_t> boundary = {});

/// Current positions of a layout's vertices, and the part of the plane that each block covers. No OpenGL.
class Placement {
 public:
  Placement() = default;
  explicit Placement(std::shared_ptr<const Layout> layout);
  /// Takes new positions, layout().vertex_count of them.
  void move(std::span<const Vec3> positions);
  /// Takes positions as OpenGL has them: relative to layout().origin.
  void move(std::span<const Vec2<float>> points);
  [[nodiscard]] const Layout& layout() const noexcept { return *layout_; }
  [[nodiscard]] bool empty() const noexcept { return layout_ == nullptr; }
  /// Plane coordinates of all vertices.
  [[nodiscard]] std::span<const Vec2<double>> points() const noexcept { return points_; }
  /// Bounds of all vertices of elements.
  [[nodiscard]] const Bounds2& bounds() const noexcept { return bounds_; }
  [[nodiscard]] const Bounds2& block_bounds(std::size_t batch, Index block) const noexcept { return block_bounds_[batch][block]; }
  /// Ranges of drawn elements whose blocks meet `window`, joined where they touch.
  [[nodiscard]] std::vector<DrawRange> visible(std::size_t batch, const Bounds2& window) const;

 private:
  void fit_boxes();
  std::shared_ptr<const Layout> layout_;
  std::vector<Vec2<double>> points_;
  std::array<std::vector<Bounds2>, 2> block_bounds_;
  Bounds2 bounds_;
};

/// True when the polygon around `point` winds about it, or the point lies on its border. Exact up to the sign of a double's
/// cross product; right for every shape, self-intersecting ones too.
[[nodiscard]] bool contains(std::span<const Index> corners, std::span<const Vec2<double>> points, Vec2<double> point);

}  // namespace dmoscope::render
