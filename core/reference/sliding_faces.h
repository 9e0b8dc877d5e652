#pragma once
// Faces of a mesh, which move with their vertices over facets that stay.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/input/input_mesh.h"
#include "core/reference/facets.h"

namespace dmoscope {

/// Range of facets beneath a face, or near it, in the input.
struct FacetsBeneath {
  Index first = kNoIndex, count = 0;  // consecutive facets
};

/// The faces of a mesh whose vertices slide. The mesh must outlive it.
class SlidingFaces {
 public:
  /// Constructs an empty set.
  SlidingFaces() = default;
  /// Faces that are themselves the facets: `facets` were split from them.
  SlidingFaces(const InputMesh& input, ElementTable faces, std::shared_ptr<const Facets> facets);
  /// Faces over facets of another mesh. `near`: by face, a facet near it, whose patch is the face's. `beside`: greatest distance of a
  /// vertex from its patch, in mesh units.
  SlidingFaces(const InputMesh& input, ElementTable faces, std::shared_ptr<const Facets> facets, std::vector<Index> near, double beside);

  [[nodiscard]] bool any() const noexcept { return facets_ != nullptr; }
  /// The facets; there must be faces.
  [[nodiscard]] const Facets& facets() const noexcept { return *facets_; }
  [[nodiscard]] const std::shared_ptr<const Facets>& shared_facets() const noexcept { return facets_; }
  [[nodiscard]] const ElementTable& table() const noexcept { return faces_; }
  /// The faces at a vertex.
  [[nodiscard]] std::span<const Index> at(Index vertex) const {
    return {faces_at_.data() + offsets_[vertex], faces_at_.data() + offsets_[vertex + 1]};
  }
  [[nodiscard]] FacetsBeneath beneath(Index face) const {
    return {near_[face], is_own_ ? static_cast<Index>(faces_.corners(face).size()) - 2 : 1};
  }
  [[nodiscard]] Index patch_of(Index face) const { return facets_->facets()[near_[face]].patch; }
  /// Whether the facets were split from the faces of the input themselves.
  [[nodiscard]] bool are_own() const noexcept { return is_own_; }

  /// Lets a vertex slide on the surface. `home`: a facet of the patch that it never leaves.
  void carry(Index vertex, Index home) { home_[vertex] = home; }
  [[nodiscard]] bool carries(Index vertex) const noexcept { return home_[vertex] != kNoIndex; }
  /// The place on the surface that is nearest to a position of a vertex that slides, however far away.
  [[nodiscard]] FacetTree::Nearest nearest(Vec3 position, Index vertex) const { return facets_->nearest(position, home_[vertex]); }
  /// Place on the surface of a vertex that slides; none for one that was put beside its patch. It is on the nearest facet, of several the
  /// first, so it follows from the position alone. `near`: a facet of the patch to begin with; a near one makes it faster.
  [[nodiscard]] std::optional<FacetPlace> place(Index vertex, Vec3 position, Index near = kNoIndex) const;

 private:
  void index(Index vertices);

  std::shared_ptr<const Facets> facets_;
  ElementTable faces_;
  std::vector<Index> offsets_, faces_at_;  // faces of each vertex
  std::vector<Index> near_;                // facet near each face
  std::vector<Index> home_;                // by vertex, a facet of its patch; kNoIndex: it does not slide on the surface
  double rounding_ = 0.0;                  // rounding of the mesh's coordinates
  double beside_ = 0.0;
  bool is_own_ = true;
};

}  // namespace dmoscope
