#pragma once
// The surface of the input as flat triangles, on which vertices slide and which no vertex ever leaves.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/mesh/plane.h"
#include "core/reference/simplex_tree.h"

namespace dmoscope {

/// A triangle of the input's surface: a triangular face, or half a quadrilateral one, split by its shorter diagonal.
struct Facet {
  std::array<Index, 3> corners;
  std::array<Index, 3> across;  // by corner, the facet beyond the opposite edge; kNoIndex: a feature edge, which nothing crosses
  Index patch = kNoIndex;       // number of the patch: facets that no feature edge parts
};

/// A facet, and the weights of its corners, which are >= 0 and add up to 1.
struct FacetPlace {
  Index facet = kNoIndex;
  std::array<double, 3> weights{};
};

/// A feature edge as a side of a facet.
struct FacetSide {
  Index low, high;  // ends of the edge
  Index facet, corner;
  friend auto operator<=>(const FacetSide&, const FacetSide&) = default;
};

/// The facets of a surface. They stay while the faces move; the mesh must outlive them.
class Facets {
 public:
  /// Splits faces into facets. `faces`: triangles and quadrilaterals. `links`: by corner of all faces, the other corner (an index of the
  /// same kind) with the same edge, if nothing parts the two faces; else kNoIndex. An edge belongs to the corner that it leaves from.
  Facets(const Mesh& mesh, const ElementTable& faces, std::span<const Index> links);

  /// First facet of a face; a quadrilateral also has the next one.
  [[nodiscard]] Index first_of(Index face) const { return first_of_[face]; }
  [[nodiscard]] std::span<const Facet> facets() const noexcept { return facets_; }
  [[nodiscard]] Vec3 point(Index vertex) const { return points_[vertex]; }
  [[nodiscard]] double twice_area(Index facet) const { return twice_areas_[facet]; }
  /// The facets beside a feature edge of the input, or the border of a surface.
  [[nodiscard]] std::span<const FacetSide> sides_of(Index a, Index b) const;
  [[nodiscard]] std::span<const FacetSide> sides() const noexcept { return sides_; }
  /// The facets around a vertex that are connected to one of them without crossing a feature edge, ascending.
  [[nodiscard]] std::vector<Index> fan_at(Index facet, Index vertex) const;
  /// Whether the facets around a corner of a facet, seen from a side that all of them face, go round it once. True at a corner where no
  /// feature edge ends, except at vertices of high valence that wind like a stair; false also if no such side was found.
  [[nodiscard]] bool covers_once(Index facet, std::size_t corner) const { return covers_once_[facet][corner]; }
  /// Number of facets that have the vertex as a corner.
  [[nodiscard]] Index count_at(Index vertex) const { return facets_at_[vertex]; }
  /// By vertex, the last facet that has it as a corner; kNoIndex for a vertex of none, and if its facets form more than one fan.
  [[nodiscard]] std::vector<Index> whole_fans() const;

  /// The facet nearest to a point, see FacetTree.
  [[nodiscard]] FacetTree::Nearest nearest(Vec3 p, Index near) const { return tree_.nearest(p, near); }
  [[nodiscard]] Vec3 at(const FacetPlace& place) const;
  /// Unit normal at a place, interpolated from the mean normals of the facets around each corner, as far as no feature edge parts them.
  /// Zero if these cancel out.
  [[nodiscard]] Vec3 normal(const FacetPlace& place) const;

  /// The corners of a facet projected into a plane.
  [[nodiscard]] std::array<Vec2<double>, 3> from_above(Index facet, const Plane& plane, Vec3 origin) const;
  /// Walks from a facet to the one that a line along the plane's normal meets, from facet to facet and across no feature edge. `target`:
  /// point in the plane, relative to `origin`. `least_cosine`: facets that are steeper than this, or turned away, end the walk. None: the
  /// walk does not get there.
  [[nodiscard]] std::optional<FacetPlace> walk(Index facet, const Plane& plane, Vec3 origin, Vec2<double> target,
                                               double least_cosine) const;

 private:
  void split(const ElementTable& faces, std::span<const Index> links);
  void find_patches();
  void find_normals();
  [[nodiscard]] bool go_round_once(std::span<const Index> around, Index vertex, Vec3 normal) const;
  void find_sides();

  std::span<const Vec3> points_;  // positions of the mesh
  std::vector<Index> first_of_;   // by face, its first facet
  std::vector<Facet> facets_;
  std::vector<double> twice_areas_;
  std::vector<Index> facets_at_;              // by vertex, number of its facets
  std::vector<std::array<Vec3, 3>> normals_;  // normals at the corners of each facet
  std::vector<std::array<bool, 3>> covers_once_;
  std::vector<FacetSide> sides_;  // sides in ascending order
  FacetTree tree_;
};

}  // namespace dmoscope
