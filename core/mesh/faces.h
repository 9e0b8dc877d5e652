#pragma once
// Faces of volume elements, and the neighbours across them.

#include <array>
#include <span>
#include <vector>

#include "core/base/progress.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// A face of an element by the element's own corners (0-based), counter-clockwise seen from outside an element that is not inverted.
struct LocalFace {
  Index count;  // 3 or 4
  std::array<Index, 4> corners;
  [[nodiscard]] constexpr std::span<const Index> span() const noexcept { return {corners.data(), count}; }
};

/// The faces of a volume element; a triangle or quadrilateral has one, itself. An element is positive if, in a tetrahedron, corner 3 lies
/// on the side to which the normal of 0, 1, 2 points; in a wedge corners 3, 4, 5 lie above 0, 1, 2; in a hexahedron 4 to 7 above 0 to 3; in
/// a pyramid 4 above 0 to 3.
[[nodiscard]] std::span<const LocalFace> faces_of(ElementKind kind) noexcept;

/// One face of one element.
struct ElementFace {
  Index element;
  Index face;  // index into faces_of(kind of the element)
  friend bool operator==(const ElementFace&, const ElementFace&) = default;
};

/// The face's 3 or 4 vertices, in faces_of()'s order; the rest is kNoIndex.
[[nodiscard]] std::array<Index, 4> vertices_of(const ElementTable& elements, ElementFace face) noexcept;

/// Up to four vertices in ascending order, so that faces and edges compare as sets; the rest is kNoIndex.
[[nodiscard]] std::array<Index, 4> corner_set(std::span<const Index> corners) noexcept;

/// For every face of every volume element, the element on its other side. Linear in the number of elements for bounded valence.
class FaceNeighbours {
 public:
  FaceNeighbours() = default;
  /// Finds the neighbours of all faces. Throws Cancelled if `progress` (may be null) says so.
  explicit FaceNeighbours(const Mesh& mesh, Progress* progress = nullptr);

  /// Neighbours of an element by local face: the element across, or kNoIndex on the boundary and if more than two elements share the face.
  /// Empty for planar elements.
  [[nodiscard]] std::span<const Index> of(Index element) const noexcept {
    return {across_.data() + offsets_[element], across_.data() + offsets_[element + 1]};
  }
  /// Local number, in the element across `at`, of that same face; kNoIndex if there is none.
  [[nodiscard]] Index face_across(const ElementTable& elements, ElementFace at) const noexcept;
  /// Faces of exactly one element, in ascending order of (element, face).
  [[nodiscard]] std::span<const ElementFace> boundary() const noexcept { return boundary_; }
  /// Faces that more than two elements share, or an element and its duplicate: one entry for each of these elements, in ascending order.
  [[nodiscard]] std::span<const ElementFace> non_manifold() const noexcept { return non_manifold_; }
  /// Number of distinct faces of the mesh.
  [[nodiscard]] std::uint64_t face_count() const noexcept { return face_count_; }

 private:
  std::vector<std::uint32_t> offsets_{0};  // number of each element's first face
  std::vector<Index> across_;
  std::vector<ElementFace> boundary_, non_manifold_;
  std::uint64_t face_count_ = 0;
};

/// Whether the two elements run their common face in the same direction; then one of them is turned inside out against the other.
[[nodiscard]] bool same_direction(const ElementTable& elements, ElementFace a, ElementFace b) noexcept;

}  // namespace dmoscope
