#pragma once
// How near the boundary of a mesh has stayed to that of its input, element by element.

#include <vector>

#include "core/input/input_mesh.h"
#include "core/mesh/position_view.h"
#include "core/reference/domain.h"

namespace dmoscope {

class ThreadPool;

struct ElementFit {
  /// The greatest distance, in mesh units: of an element's faces on the surface from the facets of the input beneath them, straight along
  /// the faces' normals; of a planar mesh, of its edges on curves from the stretches of the input that they stand for. NaN for elements
  /// with none of these, and where the input's surface does not lie beneath all of a face.
  std::vector<float> deviation;
  /// Degrees: the greatest angle between these faces and the facets beneath. Of a planar mesh empty.
  std::vector<float> tilt;
};

/// With the vertices at `positions`. Exact, see Overlay; quadrilaterals count as split by their shorter diagonals. The same for any pool.
[[nodiscard]] ElementFit element_fit(const InputMesh& input, const Domain& domain, PositionView positions, ThreadPool* pool = nullptr);

}  // namespace dmoscope
