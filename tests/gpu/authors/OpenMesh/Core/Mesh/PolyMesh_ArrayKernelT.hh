#pragma once
// In OpenMesh's place when the authors' kernel is compiled: what their DmoMesh.h names of it where a template's arguments do not matter.
// Nothing of it is ever called; driver.cu fills their DmoMesh itself.

#include <algorithm>
#include <vector>

namespace OpenMesh {

struct SmartHalfedgeHandle;
struct Mesh;

struct SmartVertexHandle {
  SmartHalfedgeHandle out() const;
  int idx() const;
  bool is_boundary() const;
  std::vector<SmartVertexHandle> vertices() const;
  const Mesh* mesh() const;
  bool operator==(const SmartVertexHandle&) const;
};

struct SmartHalfedgeHandle {
  SmartHalfedgeHandle prev() const;
  SmartHalfedgeHandle next() const;
  SmartHalfedgeHandle opp() const;
  SmartVertexHandle from() const;
  SmartVertexHandle to() const;
  bool is_boundary() const;
  bool operator!=(const SmartHalfedgeHandle&) const;
};

struct Mesh {
  std::size_t n_vertices() const;
};

}  // namespace OpenMesh
