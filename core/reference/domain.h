#pragma once
// Where the vertices of a mesh may go that slide: the curves and, of a volume, the surfaces of the input.

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/ties.h"
#include "core/reference/curves.h"
#include "core/reference/sliding_faces.h"
#include "core/reference/standing.h"
#include "core/reference/surface_ends.h"

namespace dmoscope {

/// The mesh must outlive it.
class Domain {
 public:
  /// Of a mesh that slides on the surface of another one, feature edges and corners are those of that surface; a vertex of the mesh belongs
  /// to one where it stands near it, and an edge where it runs along it. Else:
  /// In a plane a vertex of the boundary, or of an interface between materials, slides along it where the rule lets these. In a volume it
  /// slides on the boundary's surface, or on that of an interface; in a curved surface all vertices off its boundary do, and along this
  /// where the rule lets them. On feature edges they slide along these. A feature edge is one
  /// - where the surface folds by more than the feature angle, ends, or where other than two faces meet;
  /// - between faces that the file gives different names, or that it names itself.
  /// A vertex stays
  /// - where other than two of these edges meet, or where they turn by more than the corner angle or have no direction;
  /// - where sheets of the surface touch in it alone, or along an edge of the boundary with more than two faces;
  /// - that the file names: a point, an end of a string or line, a corner of a required element, or, unless interfaces are free, the end of
  ///   an interface or of a named line or face inside.
  /// A person's kinds count for more than angles: the rule's corners stay, its no-corners slide however much their curve turns, its
  /// features are feature edges, also inside a plane, and its no-features none. They do not count for more than the file, or than what
  /// touches.
  Domain(const InputMesh& input, const StandingRule& rule);

  [[nodiscard]] bool slides(Index vertex) const noexcept { return on_curve(vertex) || on_surface(vertex); }
  [[nodiscard]] bool on_curve(Index vertex) const noexcept { return curves_.slides(vertex); }
  [[nodiscard]] bool on_surface(Index vertex) const noexcept { return faces_.any() && faces_.carries(vertex); }
  [[nodiscard]] const Curves& curves() const noexcept { return curves_; }
  [[nodiscard]] const SlidingFaces& faces() const noexcept { return faces_; }  // none in a plane

  /// The edges of the mesh along which it slides or that nothing crosses, each once, low end first, ascending.
  [[nodiscard]] std::span<const EdgeEnds> feature_edges() const noexcept { return feature_edges_; }
  [[nodiscard]] bool is_feature(Index a, Index b) const;
  /// Corners, junctions and ends of feature edges, and what else is held by more than a rule.
  [[nodiscard]] bool is_held(Index vertex) const noexcept { return held_[vertex] != HeldOn::Nothing && held_[vertex] != HeldOn::Rule; }
  /// What holds a vertex of the boundary, of an interface, or of a surface; "feature edges meet there". Empty for others.
  [[nodiscard]] std::string_view why_held(Index vertex) const;
  [[nodiscard]] HeldOn held_on(Index vertex) const noexcept { return held_[vertex]; }
  /// Pairs of vertices that slide as one: the second stands where the first does, moved by a shift, and is visited with it.
  [[nodiscard]] std::span<const Partners> pairs() const noexcept { return pairs_; }
  /// The second of a first one, the first of a second one; kNoIndex of any other.
  [[nodiscard]] Index follower(Index vertex) const noexcept { return pair_of(vertex, &Partners::first, &Partners::second); }
  [[nodiscard]] Index leader(Index vertex) const noexcept { return pair_of(vertex, &Partners::second, &Partners::first); }
  /// By vertex its follower(); empty: there are no pairs.
  [[nodiscard]] std::span<const Index> followers() const noexcept { return followers_; }
  /// Position of the follower for the vertex at `place`.
  [[nodiscard]] Vec3 place_of_follower(Index vertex, Vec3 place) const;
  [[nodiscard]] Index count() const noexcept { return sliding_; }        // of vertices that slide
  [[nodiscard]] Index count_inside() const noexcept { return inside_; }  // of these, off the boundary
  [[nodiscard]] Index count_on_curves() const noexcept { return on_curves_; }
  [[nodiscard]] Index corners() const noexcept { return corners_; }  // of the boundary's others, where it slides
  /// Is an edge of what it slides on a segment of one of these stretches?
  [[nodiscard]] bool is_within(std::span<const Curves::Stretch> stretches, Index a, Index b) const;
  /// "122 vertices slide along the boundary, and 34 of its vertices stay; 36 vertices slide along interfaces".
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
  std::vector<Segment> segments_;  // of all curves, ascending
  std::vector<EdgeEnds> feature_edges_;
  std::vector<Partners> pairs_;
  std::vector<Index> pair_at_, followers_;  // by vertex; empty: no pairs
  std::vector<HeldOn> held_;                // by vertex
  std::string surface_;                     // the name of the mesh on whose surface it slides; empty: its own
  bool said_in_plane_ = false;              // whether a person names feature edges of a planar mesh
  bool is_surface_;
  Index sliding_ = 0, inside_ = 0, on_curves_ = 0, corners_ = 0;
};

/// Where the rule lets vertices slide; null where it lets none. On a curved surface whatever moves slides. Throws UsageError for kinds of
/// what the mesh does not have.
[[nodiscard]] std::shared_ptr<const Domain> domain_for(const InputMesh& input, const StandingRule& rule);

}  // namespace dmoscope
