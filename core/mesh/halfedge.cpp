#include "core/mesh/halfedge.h"

#include <algorithm>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>

namespace dmoscope {
namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using PolyMesh = OpenMesh::PolyMesh_ArrayKernelT<DoubleTraits>;

/// Keeps OpenMesh from writing "complex edge" and the like to standard error; we count the refusals instead.
class SilentErrors {
 public:
  SilentErrors() : was_enabled_(omerr().is_enabled()) { omerr().disable(); }
  ~SilentErrors() {
    if (was_enabled_) omerr().enable();
  }
  SilentErrors(const SilentErrors&) = delete;
  SilentErrors& operator=(const SilentErrors&) = delete;

 private:
  bool was_enabled_;
};

Index index_of(PolyMesh::VertexHandle v) { return static_cast<Index>(v.idx()); }

}  // namespace

struct HalfEdges::Impl {
  PolyMesh mesh;
  Index refused = 0;
};

HalfEdges::HalfEdges(const Mesh& mesh) : impl_(std::make_unique<Impl>()) {
  const SilentErrors silent;
  const ElementTable& elements = mesh.elements;
  impl_->mesh.reserve(mesh.positions.size(), elements.all_corners().size(), elements.size());
  for (const Vec3& p : mesh.positions) impl_->mesh.add_vertex({p.x, p.y, p.z});
  std::vector<PolyMesh::VertexHandle> corners;
  for (Index e = 0; e < elements.size(); ++e) {
    if (info(elements.kind(e)).dimension != 2) continue;
    corners.clear();
    bool repeated = false;
    for (const Index v : elements.corners(e)) {
      const PolyMesh::VertexHandle handle(static_cast<int>(v));
      for (const auto& earlier : corners) repeated = repeated || earlier == handle;
      corners.push_back(handle);
    }
    if (repeated || !impl_->mesh.add_face(corners).is_valid()) ++impl_->refused;
  }
}

HalfEdges::~HalfEdges() = default;
HalfEdges::HalfEdges(HalfEdges&&) noexcept = default;
HalfEdges& HalfEdges::operator=(HalfEdges&&) noexcept = default;

Index HalfEdges::refused_elements() const noexcept { return impl_->refused; }

std::vector<Index> HalfEdges::ring(Index vertex) const {
  const PolyMesh& mesh = impl_->mesh;
  const PolyMesh::VertexHandle v(static_cast<int>(vertex));
  std::vector<Index> ring;
  // Turning left: across the element to the left of an outgoing half-edge, or across the gap where there is none.
  // OpenMesh keeps the outgoing half-edge of a boundary vertex at its gap, so a boundary ring is begun behind that and ends with it.
  const auto left = [&](PolyMesh::HalfedgeHandle h) { return mesh.opposite_halfedge_handle(mesh.prev_halfedge_handle(h)); };
  const PolyMesh::HalfedgeHandle out = mesh.halfedge_handle(v);
  if (!out.is_valid()) return ring;
  const PolyMesh::HalfedgeHandle start = mesh.is_boundary(out) ? left(out) : out;
  PolyMesh::HalfedgeHandle h = start;
  do {
    ring.push_back(index_of(mesh.to_vertex_handle(h)));
    h = left(h);
  } while (h != start);
  return ring;
}

std::vector<std::vector<Index>> HalfEdges::boundary_loops() const {
  const PolyMesh& mesh = impl_->mesh;
  std::vector<std::vector<Index>> loops;
  std::vector<bool> seen(mesh.n_halfedges(), false);
  for (const auto start : mesh.halfedges()) {
    if (!mesh.is_boundary(start) || seen[static_cast<std::size_t>(start.idx())]) continue;
    std::vector<Index> loop;
    PolyMesh::HalfedgeHandle h = start;
    do {
      seen[static_cast<std::size_t>(h.idx())] = true;
      loop.push_back(index_of(mesh.to_vertex_handle(h)));
      h = mesh.next_halfedge_handle(h);
    } while (h != start);
    std::ranges::reverse(loop);  // boundary half-edges run with the mesh to the right
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace dmoscope
