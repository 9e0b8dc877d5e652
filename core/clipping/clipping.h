#pragma once
// Seeing inside a volume mesh: the faces to be drawn, found anew within milliseconds whenever a setting changes.

#include <cstdint>
#include <vector>

#include "core/clipping/plane_cut.h"
#include "core/clipping/visible_cells.h"

namespace dmoscope {

/// What is to be drawn. Its lists keep their memory from one update to the next.
struct ClippedFaces {
  /// Faces of visible cells that no visible cell covers, or all faces of these while cells are shrunk; ascending by (element, face). In cut
  /// mode those of cells that the plane passes through are whole: whoever draws them leaves out what is beyond the plane.
  std::vector<ElementFace> faces;
  std::vector<ElementFace> ghost;  // boundary faces of cells that are not visible; empty unless the view asks for them
  PlaneCuts cuts;                  // of visible cells, in cut mode
  std::size_t visible_cells = 0;
  std::uint64_t faces_revision = 0;  // grows when `faces` or `ghost` may have changed
  std::uint64_t cuts_revision = 0;   // grows when `cuts` may have changed
};

/// Which part of a mesh is seen. Takes 3.4 bytes per cell; a clip plane needs 16 more per cell and 8 per vertex.
class Clipping {
 public:
  /// Both must outlive it.
  Clipping(const ElementTable& elements, const FaceNeighbours& faces);
  /// Costs little where little changes: dragging a plane takes a pass over one number per cell, and work on the cells whose side changed.
  /// Costs nothing while view and state stay. `pool` may be null. Throws UsageError, see VisibleCells; then nothing changes.
  const ClippedFaces& update(const ClippingView& view, const CellState& state, ThreadPool* pool = nullptr);
  [[nodiscard]] const ClippedFaces& faces() const noexcept { return result_; }
  /// One per cell: 1 where it is seen.
  [[nodiscard]] std::span<const std::uint8_t> visible() const noexcept { return cells_.visible(); }

 private:
  [[nodiscard]] std::uint8_t open_faces(Index cell) const noexcept;
  void open_all(ThreadPool* pool);
  void open_changed(ThreadPool* pool);
  void gather(ThreadPool* pool);
  void gather_ghost(bool wanted);
  void cut(const ClippingView& view, const CellState& state, ThreadPool* pool);
  const ElementTable& elements_;
  const FaceNeighbours& faces_;
  VisibleCells cells_;
  std::vector<std::uint8_t> open_;  // a bit per face that is to be drawn
  std::vector<std::size_t> counts_;
  std::vector<PlaneCuts> cut_parts_;  // a chunk each
  ClippedFaces result_;
  ClippingView view_;
  std::uint64_t serial_ = 0;
  bool fresh_ = true, all_faces_ = false;
};

}  // namespace dmoscope
