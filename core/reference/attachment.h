#pragma once
// Relation of a mesh to the surface of another one, its reference.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/input/input_mesh.h"
#include "core/reference/curve_ends.h"
#include "core/reference/curves.h"
#include "core/reference/sliding_faces.h"

namespace dmoscope {

/// Finds the vertices and edges of the mesh on corners and feature lines of the reference, and the facets beneath its faces. All arguments
/// must outlive it.
class Attachment {
 public:
  /// Attaches a mesh. `faces`: its sliding faces. `facets`, `ends`: those of the reference, with its own feature edges. `fit`: see
  /// StandingRule.
  Attachment(const InputMesh& input, const ElementTable& faces, const InputMesh& reference, std::shared_ptr<const Facets> facets,
             const CurveEnds& ends, double fit);

  /// Whether a vertex of the mesh is the nearest one to a corner of the reference, and near it.
  [[nodiscard]] bool on_corner(Index vertex) const { return corner_[vertex] != 0; }
  /// Whether an edge of the mesh runs along a feature line of the reference.
  [[nodiscard]] bool is_along(Index a, Index b) const;

  /// The faces over the facets, wound like these. `own`: the same faces as facets of the mesh itself, parted along feature edges: each
  /// patch of them lies on one patch of the reference. Vertices off all edges in `ends` slide on the surface if they are near enough;
  /// others off the edges are held.
  [[nodiscard]] SlidingFaces lay(ElementTable faces, const Facets& own, CurveEnds& ends) const;
  /// The feature lines, and the line near which each vertex stands.
  [[nodiscard]] OntoLines take_lines();

 private:
  using Edge = std::array<Index, 2>;
  struct Standing {
    double along;  // index of the segment plus the share of it
    Index vertex;
    friend auto operator<=>(const Standing&, const Standing&) = default;
  };
  [[nodiscard]] double share() const;
  void find_lines(const CurveEnds& ends);
  void measure_faces(const ElementTable& faces);
  void find_corners(const CurveEnds& ends);
  void find_standing();
  void find_edges();
  [[nodiscard]] Vec3 middle_of(const ElementTable& faces, Index face) const;
  [[nodiscard]] bool runs_along(const FeatureLine& line, const Standing& from, const Standing& to) const;
  [[nodiscard]] std::vector<Index> patches_beneath(const ElementTable& faces, const Facets& own, std::span<const Index> near) const;
  [[nodiscard]] FacetTree::Nearest nearest_of(const FacetTree& all, Vec3 p, Index near, Index of_patch, double most) const;

  const InputMesh& input_;
  const InputMesh& reference_;
  std::shared_ptr<const Facets> facets_;
  bool fits_;  // whether vertices are drawn to the reference
  double beside_;
  std::vector<FeatureLine> lines_;
  std::vector<Edge> edges_;                      // edges of the faces, ascending
  std::vector<double> reach_;                    // by vertex, greatest distance from its line or corner; 0 for a vertex of no face
  std::vector<double> longest_;                  // by vertex, longest edge of its faces
  std::vector<std::uint8_t> corner_;             // by vertex, whether it is on a corner
  std::vector<Index> corner_points_;             // by vertex on a corner, that corner
  std::vector<Index> line_of_;                   // by vertex, its line
  std::vector<std::vector<Standing>> standing_;  // by line, the vertices on it
  std::vector<Edge> along_;                      // edges along lines, ascending
};

}  // namespace dmoscope
