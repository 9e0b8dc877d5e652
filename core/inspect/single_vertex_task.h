#pragma once
// The planar fast search for a single vertex.

#include <vector>

#include "core/input/input_mesh.h"
#include "core/smooth/kernels/fast_visit.h"

namespace dmoscope {

/// One vertex's star in the layout that FastVisit reads: the vertex is rank 0, its ring the ranks that follow.
class SingleVertexTask {
 public:
  SingleVertexTask(const InputMesh& input, PositionView positions, const SearchParameters& search_parameters, Index vertex)
      : frame(make_search_frame(input)), parameters(search_parameters) {
    shape_ = star_shape(input.mesh, input.topology, vertex, ranks_);
    positions_.push_back(positions[vertex]);
    for (Index& other : ranks_) {
      positions_.push_back(positions[other]);
      other = static_cast<Index>(positions_.size() - 1);
    }
    shapes = &shape_;
    others = ranks_.data();
    ranked = positions_.data();
  }
  SingleVertexTask(const SingleVertexTask&) = delete;
  SingleVertexTask& operator=(const SingleVertexTask&) = delete;

  // Members that FastVisit reads.
  const StarShape* shapes;
  const Index* others;
  const Vec3* ranked;
  SearchFrame frame;
  SearchParameters parameters;

 private:
  StarShape shape_;
  std::vector<Index> ranks_;
  std::vector<Vec3> positions_;
};

}  // namespace dmoscope
