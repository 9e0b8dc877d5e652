#pragma once
// Domain of the vertices that slide: the curves of the input and, of a volume mesh, its surfaces.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/mesh/ties.h"
#include "core/reference/curves.h"
#include "core/reference/sliding_faces.h"
#include "core/reference/standing.h"
#include "core/reference/surface_ends.h"

namespace dmoscope {

/// Curves and facets that vertices slide on. The mesh must outlive it.
class Domain {
 public:
  /// Determines the vertices that slide and those that stay. If the mesh slides on the surface of another one, feature edges and corners
  /// are those of that; a vertex of the mesh belongs to one if it is near it, and an edge if it runs along it. Otherwise: in a plane, a
  /// vertex of the boundary, or of an interface between materials, slides along it if the rule allows that. In a volume mesh it slides on
  /// the surface of the boundary or interface; in a surface mesh all vertices off its boundary slide, and those on it slide along it if the
  /// rule allows that. On feature edges vertices slide along these. An edge is a feature edge
  /// - if the surface folds there by more than the feature angle, ends there, or if not exactly two faces meet there;
  /// - if the file gives the faces beside it different names, or names the edge itself.
  /// A vertex stays
  /// - if not exactly two of these edges meet there, or if they turn by more than the corner angle or have no direction;
  /// - if sheets of the surface touch in it alone, or along an edge of the boundary with more than two faces;
  /// - if the file names it: a point, an end of a string or line, a corner of a required element, or, unless interfaces are free, the end
  ///   of an interface or of a named line or face inside.
  /// Kinds by hand override angles: the rule's corners stay, its no-corners slide however much their curve turns, its features are feature
  /// edges, also inside a plane, and its no-features are none. They override neither the file nor touching parts.
  Domain(const InputMesh& input, const StandingRule& rule);

  [[nodiscard]] bool slides(Index vertex) const noexcept { return on_curve(vertex) || on_surface(vertex); }
  [[nodiscard]] bool on_curve(Index vertex) const noexcept { return curves_.slides(vertex); }
  [[nodiscard]] bool on_surface(Index vertex) const noexcept { return faces_.any() && faces_.carries(vertex); }
  /// The corner of another mesh's surface that a vertex belongs to, where it slides on that.
  [[nodiscard]] std::optional<Vec3> corner(Index vertex) const;
  [[nodiscard]] const Curves& curves() const noexcept { return curves_; }
  [[nodiscard]] const SlidingFaces& faces() const noexcept { return faces_; }  // faces of the surface; none in a plane

  /// The feature edges of the mesh, each once, low end first, ascending.
  [[nodiscard]] std::span<const EdgeEnds> feature_edges() const noexcept { return feature_edges_; }
  [[nodiscard]] bool is_feature(Index a, Index b) const;
  /// Whether a vertex is held by more than a rule: corners, junctions and ends of feature edges, and others.
  [[nodiscard]] bool is_held(Index vertex) const noexcept { return held_[vertex] != HeldOn::Nothing && held_[vertex] != HeldOn::Rule; }
  /// Reason why a vertex of the boundary, of an interface, or of a surface is held: "feature edges meet there". Empty for others.
  [[nodiscard]] std::string_view why_held(Index vertex) const;
  [[nodiscard]] HeldOn held_on(Index vertex) const noexcept { return held_[vertex]; }
  /// Pairs of vertices that slide as one: the second is at the place of the first plus a shift, and is visited with it.
  [[nodiscard]] std::span<const Partners> pairs() const noexcept { return pairs_; }
  /// The second vertex of a pair for the first; kNoIndex for others.
  [[nodiscard]] Index follower(Index vertex) const noexcept { return pair_of(vertex, &Partners::first, &Partners::second); }
  [[nodiscard]] Index leader(Index vertex) const noexcept { return pair_of(vertex, &Partners::second, &Partners::first); }
  /// By vertex, its follower(); empty: there are no pairs.
  [[nodiscard]] std::span<const Index> followers() const noexcept { return followers_; }
  /// Position of the follower for the vertex at `place`.
  [[nodiscard]] Vec3 place_of_follower(Index vertex, Vec3 place) const;
  [[nodiscard]] Index count() const noexcept { return sliding_; }        // number of vertices that slide
  [[nodiscard]] Index count_inside() const noexcept { return inside_; }  // number of those off the boundary
  [[nodiscard]] Index count_on_curves() const noexcept { return on_curves_; }
  [[nodiscard]] Index corners() const noexcept { return corners_; }  // number of vertices of the boundary that stay, if it slides
  /// Whether an edge of the mesh slid along is a segment of one of these stretches.
  [[nodiscard]] bool is_within(std::span<const Curves::Stretch> stretches, Index a, Index b) const;
  /// Sentence on the numbers of vertices: "122 vertices slide along the boundary, and 34 of its vertices stay; 36 vertices slide along
  /// interfaces".
  [[nodiscard]] std::string sentence() const;

 private:
  struct Segment {
    Index low, high, curve, segment;
    friend auto operator<=>(const Segment&, const Segment&) = default;
  };
  Domain(const InputMesh& input, const StandingRule& rule, SurfaceEnds ends);
  void find_feature_edges();
  void take_pairs(const InputMesh& input);
  [[nodiscard]] Index pair_of(Index vertex, Index Partners::*own, Index Partners::*other) const noexcept {
    if (pair_at_.empty() || pair_at_[vertex] == kNoIndex) return kNoIndex;
    const Partners& pair = pairs_[pair_at_[vertex]];
    return pair.*own == vertex ? pair.*other : kNoIndex;
  }

  Curves curves_;
  SlidingFaces faces_;
  std::vector<Segment> segments_;  // segments of all curves, ascending
  std::vector<EdgeEnds> feature_edges_;
  std::vector<Partners> pairs_;
  std::vector<Index> pair_at_, followers_;             // by vertex; empty: no pairs
  std::vector<HeldOn> held_;                           // by vertex
  std::vector<std::pair<Index, Vec3>> corner_points_;  // see corner()
  std::string surface_;                                // the name of the mesh on whose surface it slides; empty: its own
  bool said_in_plane_ = false;                         // whether a person names feature edges of a planar mesh
  bool is_surface_, single_precision_;
  Index sliding_ = 0, inside_ = 0, on_curves_ = 0, corners_ = 0;
};

/// The domain that a rule gives; null if no vertex slides. On a curved surface every vertex that moves slides. Throws UsageError for kinds
/// of vertices or edges that the mesh does not have.
[[nodiscard]] std::shared_ptr<const Domain> domain_for(const InputMesh& input, const StandingRule& rule);

}  // namespace dmoscope
