#pragma once
// Distance of a mesh's boundary from that of its input, element by element.

#include <vector>

#include "core/input/input_mesh.h"
#include "core/mesh/position_view.h"
#include "core/reference/domain.h"

namespace dmoscope {

class ThreadPool;

struct ElementFit {
  /// The greatest distance for each element, in mesh units: of its faces on the surface from the facets of the input beneath them, along
  /// the faces' normals; in a planar mesh, of its edges on curves from the corresponding stretches of the input. NaN for elements with none
  /// of these, and if the input's surface does not lie beneath all of a face.
  std::vector<float> deviation;
  /// The greatest angle between these faces and the facets beneath, in degrees. Empty for a planar mesh.
  std::vector<float> tilt;
};

/// The fit with the vertices at `positions`. Exact, see Overlay; quadrilaterals count as split by their shorter diagonals. The result does
/// not depend on the pool.
[[nodiscard]] ElementFit element_fit(const InputMesh& input, const Domain& domain, PositionView positions, ThreadPool* pool = nullptr);

}  // namespace dmoscope
