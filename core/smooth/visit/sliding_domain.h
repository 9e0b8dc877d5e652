#pragma once
// Curves and surfaces along which vertices slide (core/reference/domain.h), for visits of single vertices.

#include <memory>
#include <optional>
#include <vector>

#include "core/reference/deviation_bound.h"
#include "core/smooth/task.h"

namespace dmoscope {

class SlidingDomain {
 public:
  explicit SlidingDomain(const SmoothingTask& task);

  [[nodiscard]] bool slides(Index vertex) const { return domain_ != nullptr && domain_->slides(vertex); }
  [[nodiscard]] bool on_curve(Index vertex) const { return domain_->on_curve(vertex); }
  /// Vertex that moves with another one, and the place to which it goes: see Domain.
  [[nodiscard]] Index follower(Index vertex) const { return domain_->follower(vertex); }
  [[nodiscard]] Vec3 place_of_follower(Index vertex, Vec3 place) const { return domain_->place_of_follower(vertex, place); }
  [[nodiscard]] const Curves& curves() const { return domain_->curves(); }
  [[nodiscard]] const SlidingFaces& faces() const { return domain_->faces(); }
  [[nodiscard]] const Facets& facets() const { return domain_->faces().facets(); }
  [[nodiscard]] const DeviationBound& bound() const { return *bound_; }
  [[nodiscard]] bool single_precision() const noexcept { return single_precision_; }

  /// Finds the facet beneath a vertex on a surface; none where the surface is not near it.
  [[nodiscard]] std::optional<FacetPlace> place(Index vertex, Vec3 position) const;
  /// Notes the facet beneath the new place of a vertex, from which the next look starts.
  void expect(Index vertex, Index facet) const;

 private:
  std::shared_ptr<const Domain> domain_;  // null: nothing slides
  std::optional<DeviationBound> bound_;   // none: nothing slides
  bool single_precision_;
  /// Last place of a vertex on the surface. It follows from the position, so no result depends on it; one visit at a time looks at it.
  struct Found {
    Vec3 position{};
    FacetPlace place{};  // facet: begin of the look for another position; kNoIndex: not found yet
    bool valid = false;  // whether `place` belongs to the position
  };
  mutable std::vector<Found> found_;  // last places, by vertex
};

}  // namespace dmoscope
