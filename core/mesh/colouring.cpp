#include "core/mesh/colouring.h"

#include <numeric>
#include <utility>

#include "core/mesh/random.h"

namespace dmoscope {

Colouring colour_vertices(const Mesh& mesh, const Topology& topology, std::span<const Index> free_vertices) {
  std::vector<Index> colour(mesh.positions.size(), kNoIndex);
  std::vector<Index> taken_by;  // taken_by[c] == v: colour c is taken near v
  std::vector<Index> class_size;
  for (const Index v : free_vertices) {
    for (const Incidence& incidence : topology.star(v)) {
      for (const Index other : mesh.elements.corners(incidence.element)) {
        if (colour[other] != kNoIndex) taken_by[colour[other]] = v;
      }
    }
    Index c = 0;
    while (c < taken_by.size() && taken_by[c] == v) ++c;
    if (c == taken_by.size()) {
      taken_by.push_back(kNoIndex);
      class_size.push_back(0);
    }
    colour[v] = c;
    ++class_size[c];
  }

  Colouring result;
  result.class_offsets.resize(class_size.size() + 1, 0);
  std::partial_sum(class_size.begin(), class_size.end(), result.class_offsets.begin() + 1);
  result.order.resize(free_vertices.size());
  std::vector<Index> next(result.class_offsets.begin(), result.class_offsets.end() - 1);
  for (const Index v : free_vertices) result.order[next[colour[v]]++] = v;
  return result;
}

std::vector<Index> shuffled(std::span<const Index> vertices, std::uint64_t seed) {
  std::vector<Index> order(vertices.begin(), vertices.end());
  Random random(seed);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);  // Fisher-Yates
  return order;
}

}  // namespace dmoscope
