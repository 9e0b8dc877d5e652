#pragma once
// What each rank has read of a mesh: consecutive vertices and consecutive elements, of which neither need touch the other.

#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/mesh.h"
#include "mpi/world/world.h"

namespace dmoscope {

/// Numbers of vertices and elements of a whole mesh, which may have more of them than an Index counts.
using WholeIndex = std::uint64_t;

/// One number for each vertex or element of the block, which the file carried.
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
  Ranges vertices, elements;        // which rank has which
  std::vector<Vec3> positions;      // of this rank's vertices
  std::vector<ElementKind> kinds;   // of its elements
  std::vector<WholeIndex> corners;  // likewise, element after element, in our order
  std::vector<BlockField> fields;   // those that were asked for, see FieldFilter
  std::vector<VertexString> strings;
  bool single_precision = false;  // see Mesh
};

/// Deals a block's vertices and elements out evenly, in their order: of a text the first ranks have read all vertices, and the last ones
/// all elements. All ranks together.
void spread_evenly(const World& world, MeshBlock& block);

/// Which of a file's numbers are wanted: those that name materials, and those of these names.
struct FieldFilter {
  std::vector<std::string> names;
  [[nodiscard]] bool wants(const std::string& name, Field::On on) const;
};

}  // namespace dmoscope
