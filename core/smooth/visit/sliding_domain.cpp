#include "core/smooth/visit/sliding_domain.h"

namespace dmoscope {

SlidingDomain::SlidingDomain(const SmoothingTask& task) : domain_(task.domain), single_precision_(task.input->mesh.single_precision) {
  if (domain_ == nullptr) return;
  bound_.emplace(*domain_, task.max_deviation);
  if (domain_->faces().any()) found_.resize(task.input->mesh.positions.size());
}

std::optional<FacetPlace> SlidingDomain::place(Index vertex, Vec3 position) const {
  Found& found = found_[vertex];
  if (found.valid && found.position == position) return found.place;
  const auto place = faces().place(vertex, position, found.place.facet);
  found.valid = place.has_value();
  if (place) found.position = position, found.place = *place;
  return place;
}

void SlidingDomain::expect(Index vertex, Index facet) const {
  found_[vertex].place.facet = facet;
  found_[vertex].valid = false;
}

}  // namespace dmoscope
