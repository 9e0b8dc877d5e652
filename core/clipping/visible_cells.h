#pragma once
// Visible cells of a volume mesh.

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/clipping/clipped_view.h"
#include "core/mesh/faces.h"

namespace dmoscope {

/// Positions of the vertices and qualities of the cells.
struct CellState {
  std::span<const Vec3> positions;
  std::span<const float> quality;          // quality by cell; NaN: not defined
  std::span<const std::uint8_t> inverted;  // flags by cell, or empty: none is inverted
  std::uint64_t serial = 0;                // changes whenever any of the above does
};

/// Number of cells between each cell and the boundary, counted through faces: 0 for those with a face on it, kNoIndex for those without a
/// path to it. Linear in the number of cells.
[[nodiscard]] std::vector<Index> layers_of(const ElementTable& elements, const FaceNeighbours& faces);

/// A chunk of cells, with those of them that changed and, in cut mode, those that the plane passes through.
struct CellChunk {
  static constexpr std::size_t kCells = 16384;
  std::vector<Index> changed, crossed;
  std::size_t visible = 0;
};

/// Finds the visible cells. Keeps everything that does not depend on a dragged plane, so that this costs one pass over one number per cell.
class VisibleCells {
 public:
  /// Prepares the search. Both arguments must outlive it.
  VisibleCells(const ElementTable& elements, const FaceNeighbours& faces);
  /// Finds the visible cells of a view. Throws UsageError for a view or a state that does not fit: a normal of length 0, NaN, or a number
  /// of qualities other than that of cells.
  void update(const ClippingView& view, const CellState& state, ThreadPool* pool);
  /// By cell, 1 if it is visible.
  [[nodiscard]] std::span<const std::uint8_t> visible() const noexcept { return visible_; }
  /// The chunks of the last update, in ascending order of cells.
  [[nodiscard]] std::span<const CellChunk> chunks() const noexcept { return chunks_; }
  [[nodiscard]] std::size_t changed_count() const noexcept;
  [[nodiscard]] std::size_t visible_count() const noexcept;

 private:
  void measure(Vec3 normal, const CellState& state, ThreadPool* pool);
  void rank_worst(std::size_t count, const CellState& state);
  const ElementTable& elements_;
  const FaceNeighbours& faces_;
  std::vector<std::uint8_t> visible_;
  std::vector<CellChunk> chunks_;
  std::vector<Index> layers_;  // layers of the cells; empty until they are needed
  std::vector<double> heights_, low_, high_;
  Vec3 measured_normal_{};  // normal of the heights; {0, 0, 0}: none
  std::uint64_t measured_serial_ = 0;
  std::vector<std::uint8_t> among_worst_;
  std::size_t ranked_count_ = 0;  // number of ranked cells; 0: none
  std::uint64_t ranked_serial_ = 0;
};

}  // namespace dmoscope
