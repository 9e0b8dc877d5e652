#include "core/reference/slide_on.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/reference/surface_ends.h"

namespace dmoscope {

namespace {

/// Normals for InputMesh::surface_normals: that of the facet beneath each element, reversed for an element wound against the reference.
std::vector<Vec3> surface_normals(const InputMesh& input) {
  const SlidingFaces faces = surface_ends(input, {InterfaceRule::Slide, BoundaryRule::Slide}).faces;
  const Facets& facets = faces.facets();
  std::vector<Vec3> normals;
  normals.reserve(input.mesh.elements.size());
  for (Index e = 0; e < input.mesh.elements.size(); ++e) {
    const auto& corners = facets.facets()[faces.beneath(e).first].corners;
    const Vec3 a = facets.point(corners[0]), across = cross(facets.point(corners[1]) - a, facets.point(corners[2]) - a);
    const double size = length(across);
    const bool wound_alike = std::ranges::equal(faces.table().corners(e), input.mesh.elements.corners(e));
    normals.push_back(size > 0.0 ? ((wound_alike ? 1.0 : -1.0) / size) * across : Vec3{});
  }
  return normals;
}

void find_inverted(InputMesh& input) {
  auto& inverted = input.report.inverted_elements;
  const auto& degenerate = input.report.degenerate_elements;
  inverted.clear();
  for (Index e = 0; e < input.mesh.elements.size(); ++e)
    if (!std::ranges::binary_search(degenerate, e) && !(smallest_jacobian(input.quality_context(), input.mesh.positions, e) > 0.0))
      inverted.push_back(e);
}

}  // namespace

std::shared_ptr<const InputMesh> slide_on(const InputMesh& mesh, std::shared_ptr<const InputMesh> surface) {
  if (surface && !mesh.in_space())
    throw UsageError(
        fmt::format("{} is planar: its vertices slide in its plane and along its own boundary, on no other surface", mesh.mesh.name));
  if (surface && !surface->in_space())
    throw UsageError(fmt::format("{} is planar: to slide on takes a mesh of a curved surface, or of a volume", surface->mesh.name));
  auto result = std::make_shared<InputMesh>(mesh);
  result->surface = std::move(surface);
  result->surface_normals.clear();
  if (!mesh.is_surface()) return result;
  if (result->surface) result->surface_normals = surface_normals(*result);
  find_inverted(*result);
  return result;
}

}  // namespace dmoscope
