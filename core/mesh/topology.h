#pragma once
// Vertex stars in CSR form, and the boundary.

#include <span>
#include <utility>
#include <vector>

#include "core/mesh/incidence.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

class FaceNeighbours;
class Progress;
struct EdgeSurvey;

/// Stars of all vertices, any valence, incident elements in ascending order. Elements of every dimension have their place in the
/// stars; edges and boundary are those of the planar elements, or of a volume's faces.
class Topology {
 public:
  explicit Topology(const Mesh& mesh);
  /// Builds the topology of a planar or surface mesh, and returns the edges found on the way. Throws Cancelled.
  Topology(const Mesh& mesh, EdgeSurvey& found, Progress& progress);
  /// Builds the topology of a volume mesh.
  Topology(const Mesh& mesh, const FaceNeighbours& faces);
  /// Updates the places of corners after the winding of elements was reversed. Edges and boundary stay.
  void follow(const Mesh& mesh);
  [[nodiscard]] Index vertex_count() const noexcept { return static_cast<Index>(offsets_.size() - 1); }
  [[nodiscard]] std::span<const Incidence> star(Index vertex) const noexcept {
    return {incidences_.data() + offsets_[vertex], incidences_.data() + offsets_[vertex + 1]};
  }
  /// The stars of all vertices, one after the other, and vertex_count() + 1 offsets into them.
  [[nodiscard]] std::span<const Incidence> incidences() const noexcept { return incidences_; }
  [[nodiscard]] std::span<const std::uint32_t> star_offsets() const noexcept { return offsets_; }
  /// 1 for vertices on the boundary: an end of an edge, a corner of a volume's face, that has exactly one element, or more than two
  /// (non-manifold).
  [[nodiscard]] std::span<const std::uint8_t> boundary() const noexcept { return boundary_; }
  /// Sets the boundary of a share of a mesh, if other ranks know more of it (see MeshShare): one entry for each vertex.
  void set_boundary(std::vector<std::uint8_t> boundary) { boundary_ = std::move(boundary); }
  [[nodiscard]] Index edge_count() const noexcept { return edge_count_; }

 private:
  EdgeSurvey index(const Mesh& mesh, Progress* progress);

  std::vector<std::uint32_t> offsets_;
  std::vector<Incidence> incidences_;
  std::vector<std::uint8_t> boundary_;
  Index edge_count_ = 0;
};

}  // namespace dmoscope
