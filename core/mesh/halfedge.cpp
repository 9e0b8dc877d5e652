#include "core/mesh/halfedge.h"

#ifdef DMOSCOPE_HALFEDGES

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

/// Keeps OpenMesh from writing "complex edge" and the like to standard error; refusals are counted instead.
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
  Index elements = 0;             // elements of the mesh
  std::vector<Index> element_of;  // element of each face
  Index refused = 0;
};

HalfEdges::HalfEdges(const Mesh& mesh) : impl_(std::make_unique<Impl>()) {
  const SilentErrors silent;
  const ElementTable& elements = mesh.elements;
  impl_->mesh.reserve(mesh.positions.size(), elements.all_corners().size(), elements.size());
  for (const Vec3& p : mesh.positions) impl_->mesh.add_vertex({p.x, p.y, p.z});
  impl_->elements = elements.size();
  std::vector<PolyMesh::VertexHandle> corners;
  for (Index e = 0; e < elements.size(); ++e) {
    if (info(elements.kind(e)).dimension != 2) continue;
    corners.clear();
    const auto own = elements.corners(e);
    for (std::size_t i = 0; i < own.size(); ++i)
      if (own[i] != own[(i + 1) % own.size()]) corners.emplace_back(static_cast<int>(own[i]));
    const bool repeated = corners.size() == 4 && (corners[0] == corners[2] || corners[1] == corners[3]);
    if (repeated || corners.size() < 3 || !impl_->mesh.add_face(corners).is_valid()) {
      ++impl_->refused;
    } else {
      impl_->element_of.push_back(e);
    }
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
  // Turns left: across the element to the left of an outgoing half-edge, or across the gap. OpenMesh keeps the outgoing half-edge of a
  // boundary vertex at its gap, so a boundary ring begins behind that and ends with it.
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

std::vector<HalfEdges::Loop> HalfEdges::boundary_loops() const {
  const PolyMesh& mesh = impl_->mesh;
  std::vector<Loop> loops;
  std::vector<bool> seen(mesh.n_halfedges(), false);
  for (const auto start : mesh.halfedges()) {
    if (!mesh.is_boundary(start) || seen[static_cast<std::size_t>(start.idx())]) continue;
    const auto face = static_cast<std::size_t>(mesh.face_handle(mesh.opposite_halfedge_handle(start)).idx());
    Loop loop{{}, impl_->element_of[face]};
    PolyMesh::HalfedgeHandle h = start;
    do {
      seen[static_cast<std::size_t>(h.idx())] = true;
      loop.vertices.push_back(index_of(mesh.to_vertex_handle(h)));
      h = mesh.next_halfedge_handle(h);
    } while (h != start);
    std::ranges::reverse(loop.vertices);  // boundary half-edges run with the mesh to their right
    loops.push_back(std::move(loop));
  }
  return loops;
}

std::vector<Index> HalfEdges::parts() const {
  const PolyMesh& mesh = impl_->mesh;
  std::vector<Index> part(impl_->elements, kNoIndex);
  std::vector<PolyMesh::FaceHandle> open;
  Index parts = 0;
  const auto element_of = [&](PolyMesh::FaceHandle face) { return impl_->element_of[static_cast<std::size_t>(face.idx())]; };
  const auto enter = [&](PolyMesh::FaceHandle face) {
    if (!face.is_valid() || part[element_of(face)] != kNoIndex) return;
    part[element_of(face)] = parts;
    open.push_back(face);
  };
  for (const auto face : mesh.faces()) {
    enter(face);
    if (open.empty()) continue;
    while (!open.empty()) {
      const PolyMesh::FaceHandle at = open.back();
      open.pop_back();
      const PolyMesh::HalfedgeHandle start = mesh.halfedge_handle(at);
      PolyMesh::HalfedgeHandle h = start;
      do {
        enter(mesh.face_handle(mesh.opposite_halfedge_handle(h)));
        h = mesh.next_halfedge_handle(h);
      } while (h != start);
    }
    ++parts;
  }
  return part;
}

}  // namespace dmoscope

#else

#include "core/base/error.h"

namespace dmoscope {

struct HalfEdges::Impl {};
HalfEdges::HalfEdges(const Mesh& /*mesh*/) { throw UsageError("boundary loops, parts and rings need OpenMesh, which this build lacks"); }
HalfEdges::~HalfEdges() = default;
HalfEdges::HalfEdges(HalfEdges&&) noexcept = default;
HalfEdges& HalfEdges::operator=(HalfEdges&&) noexcept = default;
Index HalfEdges::refused_elements() const noexcept { return 0; }
std::vector<Index> HalfEdges::ring(Index /*vertex*/) const { return {}; }
std::vector<HalfEdges::Loop> HalfEdges::boundary_loops() const { return {}; }
std::vector<Index> HalfEdges::parts() const { return {}; }

}  // namespace dmoscope

#endif
