#pragma once
// A rank's part of a mesh file: consecutive vertices and consecutive elements, of which neither need touch the other.

#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/mesh.h"
#include "mpi/world/world.h"

namespace dmoscope {

/// Numbers of vertices and elements of a whole mesh, which may have more of them than an Index counts.
using WholeIndex = std::uint64_t;

/// One number of the file for each vertex or element of the block.
struct BlockField {
  std::string name;
  Field::On on = Field::On::Elements;
  std::vector<double> values;
};

/// Vertices that keep their place since they lie on a string of the file (fort.14). All ranks have all of them.
struct VertexString {
  std::string name;
  std::vector<WholeIndex> vertices;
};

struct MeshBlock {
  Ranges vertices, elements;        // the ranks' ranges
  std::vector<Vec3> positions;      // positions of this rank's vertices
  std::vector<ElementKind> kinds;   // kinds of this rank's elements
  std::vector<WholeIndex> corners;  // corners of this rank's elements, one after the other, in the program's order
  std::vector<BlockField> fields;   // fields that FieldFilter selects
  std::vector<VertexString> strings;
  bool single_precision = false;  // see Mesh
};

/// Deals the vertices and elements of all blocks out evenly, in their order: after reading a text the first ranks have all vertices, and
/// the last ones all elements. To be called by all ranks together.
void spread_evenly(const World& world, MeshBlock& block);

/// Selection of a file's fields: those that name materials, and those of these names.
struct FieldFilter {
  std::vector<std::string> names;
  [[nodiscard]] bool wants(const std::string& name, Field::On on) const;
};

}  // namespace dmoscope
