#include "mpi/mesh/mesh_block.h"

#include <algorithm>
#include <utility>

#include "core/mesh/materials.h"

namespace dmoscope {

namespace {

/// Finds the cuts of this rank's things for their next holders, given by `to`; the first is thing 0 of the rank.
std::vector<std::uint64_t> cuts(const World& world, const Ranges& from, const Ranges& to) {
  const std::uint64_t begin = from.begin(world.rank()), end = from.end(world.rank());
  std::vector<std::uint64_t> offsets{0};
  for (int rank = 0; rank < world.size(); ++rank) offsets.push_back(std::clamp(to.end(rank), begin, end) - begin);
  return offsets;
}

template <Plain T>
void send(const World& world, std::vector<T>& values, std::vector<std::uint64_t> offsets) {
  Parts<T> parts{std::move(values), std::move(offsets)};
  values = world.exchange(parts).values;
}

}  // namespace

void spread_evenly(const World& world, MeshBlock& block) {
  const Ranges vertices(block.vertices.size(), world.size()), elements(block.elements.size(), world.size());
  const std::vector<std::uint64_t> of_vertices = cuts(world, block.vertices, vertices), of_elements = cuts(world, block.elements, elements);
  std::vector<std::uint64_t> of_corners{0};
  std::uint64_t corner = 0, e = 0;
  for (std::size_t rank = 1; rank < of_elements.size(); ++rank) {
    for (; e < of_elements[rank]; ++e) corner += info(block.kinds[e]).corners;
    of_corners.push_back(corner);
  }
  send(world, block.positions, of_vertices);
  send(world, block.corners, of_corners);
  send(world, block.kinds, of_elements);
  for (BlockField& field : block.fields) send(world, field.values, field.on == Field::On::Vertices ? of_vertices : of_elements);
  block.vertices = vertices;
  block.elements = elements;
}

bool FieldFilter::wants(const std::string& name, Field::On on) const {
  if (std::ranges::find(names, name) != names.end()) return true;
  return on == Field::On::Elements && naming_by_name(name) != Naming::Nothing;
}

}  // namespace dmoscope
