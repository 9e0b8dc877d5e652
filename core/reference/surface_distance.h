#pragma once
// Distances between the surface of a mesh and its reference, the surface of another one.

#include <string>
#include <vector>

#include "core/input/input_mesh.h"
#include "core/mesh/position_view.h"

namespace dmoscope {

/// Distances of the vertices and middles of one surface from another one, in mesh units.
struct Distances {
  double mean = 0.0, greatest = 0.0;
};
struct SurfaceDistance {
  Distances to;               // of the mesh from the reference
  Distances back;             // of the reference from the mesh
  std::vector<Index> beside;  // vertices of the mesh's surface that are not on the reference, ascending
};

/// Distances both ways between the boundary of a volume mesh, or a surface mesh, at `positions` and input.surface, which there must be.
/// Quadrilaterals count as split by a diagonal.
[[nodiscard]] SurfaceDistance surface_distance(const InputMesh& input, PositionView positions);

/// Sentence on a fit: how near the two surfaces were and are, and which vertices do not reach the reference.
[[nodiscard]] std::string fit_sentence(const InputMesh& input, const SurfaceDistance& before, const SurfaceDistance& after);

}  // namespace dmoscope
