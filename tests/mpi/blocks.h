#pragma once
// Meshes that every rank of a test has as a whole, and their parts.

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/input/input_mesh.h"
#include "core/mesh/generate.h"
#include "core/mesh/random.h"
#include "mpi/smooth/shared_mesh.h"

namespace dmoscope::testing {

/// A mesh, and its difference from the generator's.
struct Sample {
  std::string name;
  Mesh mesh;
};

[[nodiscard]] inline Mesh generated(const char* name, std::size_t size, std::uint64_t seed = 1) {
  Progress unwatched;
  Mesh mesh = generate_mesh(name, size, seed, unwatched);
  mesh.groups.clear();  // blocks have none
  mesh.fields.clear();
  return mesh;
}

/// Turns some elements over.
[[nodiscard]] inline Mesh with_turned_elements(Mesh mesh, std::uint64_t seed) {
  Random random(seed);
  for (Index e = 0; e < mesh.elements.size(); ++e)
    if (random.below(3) == 0) mesh.elements.flip(e);
  return mesh;
}

/// Numbers the mesh at random.
[[nodiscard]] inline Mesh shuffled_mesh(const Mesh& mesh, std::uint64_t seed) {
  std::vector<Index> order(mesh.positions.size()), elements(mesh.elements.size());
  for (Index v = 0; v < order.size(); ++v) order[v] = v;
  for (Index e = 0; e < elements.size(); ++e) elements[e] = e;
  order = shuffled(order, seed);
  elements = shuffled(elements, seed + 1);
  Mesh other;
  other.positions.resize(order.size());
  for (Index v = 0; v < order.size(); ++v) other.positions[order[v]] = mesh.positions[v];
  for (const Index e : elements) {
    std::vector<Index> corners;
    for (const Index v : mesh.elements.corners(e)) corners.push_back(order[v]);
    other.elements.add(mesh.elements.kind(e), corners);
  }
  return other;
}

/// A field "material" of three vertical stripes.
[[nodiscard]] inline Mesh with_stripes(Mesh mesh) {
  double low = 1e300, high = -1e300;
  for (const Vec3& p : mesh.positions) low = std::min(low, p.x), high = std::max(high, p.x);
  Field field{"material", Field::On::Elements, 1, "int", "", {}};
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    const double x = mesh.positions[mesh.elements.corners(e)[0]].x;
    field.values.push_back(std::floor(3.0 * (x - low) / (high - low + 1e-9)));
  }
  mesh.fields.push_back(std::move(field));
  return mesh;
}

/// Puts two copies beside each other.
[[nodiscard]] inline Mesh twice(const Mesh& mesh) {
  Mesh two;
  two.positions = mesh.positions;
  two.elements = mesh.elements;
  double low = 1e300, high = -1e300;
  for (const Vec3& p : mesh.positions) low = std::min(low, p.x), high = std::max(high, p.x);
  const Index first = mesh.vertex_count();
  for (const Vec3& p : mesh.positions) two.positions.push_back({p.x + 2.0 * (high - low), p.y, p.z});
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    std::vector<Index> corners;
    for (const Index v : mesh.elements.corners(e)) corners.push_back(first + v);
    two.elements.add(mesh.elements.kind(e), corners);
  }
  return two;
}

/// A sheet that is folded on itself: as many elements look up as down, and all have one size.
[[nodiscard]] inline Mesh folded_lattice(Index cells) {
  Mesh mesh;
  const Index side = cells + 1;
  for (Index j = 0; j < side; ++j)
    for (Index i = 0; i < side; ++i) mesh.positions.push_back({std::abs(1.0 * i - 0.5 * cells), 1.0 * j, 0.0});
  for (Index j = 0; j < cells; ++j)
    for (Index i = 0; i < cells; ++i) {
      const Index v = j * side + i;
      for (const std::array<Index, 3>& corners : {std::array{v, v + 1, v + side + 1}, std::array{v, v + side + 1, v + side}})
        mesh.elements.add(ElementKind::Triangle, corners);
    }
  return mesh;
}

[[nodiscard]] inline std::vector<Sample> samples() {
  std::vector<Sample> all;
  for (const char* name : {"coast", "random", "quads", "mixed", "tangled", "block"}) all.push_back({name, generated(name, 400, 3)});
  for (const char* name : {"tetrahedra", "hexahedra", "solids", "tangled-solids"}) all.push_back({name, generated(name, 300, 2)});
  all.push_back({"coast turned", with_turned_elements(generated("coast", 300), 5)});
  all.push_back({"solids turned", with_turned_elements(generated("solids", 200), 5)});
  // Turned elements are known to most ranks, and none to the first.
  all.push_back({"later elements turned", generated("grid", 300)});
  for (Index e = all.back().mesh.elements.size() / 5; e < all.back().mesh.elements.size(); ++e) all.back().mesh.elements.flip(e);
  all.push_back({"random numbers", shuffled_mesh(generated("coast", 500), 7)});
  all.push_back({"volume, random numbers", shuffled_mesh(generated("solids", 250), 7)});
  all.push_back({"stripes", with_stripes(generated("random", 400))});
  all.push_back({"two parts, one turned", twice(generated("mixed", 150))});
  for (Index e = 0; e < all.back().mesh.elements.size() / 2; ++e) all.back().mesh.elements.flip(e);
  all.push_back({"nine vertices", generated("grid", 9)});
  all.push_back({"folded", folded_lattice(8)});
  return all;
}

[[nodiscard]] inline MeshBlock block_of(const World& world, const Mesh& mesh) {
  MeshBlock block;
  block.vertices = Ranges(mesh.positions.size(), world.size());
  block.elements = Ranges(mesh.elements.size(), world.size());
  block.single_precision = mesh.single_precision;
  for (WholeIndex v = block.vertices.begin(world.rank()); v < block.vertices.end(world.rank()); ++v)
    block.positions.push_back(mesh.positions[v]);
  for (WholeIndex e = block.elements.begin(world.rank()); e < block.elements.end(world.rank()); ++e) {
    block.kinds.push_back(mesh.elements.kind(static_cast<Index>(e)));
    for (const Index v : mesh.elements.corners(static_cast<Index>(e))) block.corners.push_back(v);
  }
  for (const Field& field : mesh.fields) {
    BlockField part{field.name, field.on, {}};
    const Ranges& rows = field.on == Field::On::Vertices ? block.vertices : block.elements;
    for (WholeIndex i = rows.begin(world.rank()); i < rows.end(world.rank()); ++i) part.values.push_back(field.values[i]);
    block.fields.push_back(std::move(part));
  }
  return block;
}

[[nodiscard]] inline std::shared_ptr<const InputMesh> whole_input(const Mesh& mesh) {
  Progress unwatched;
  return prepare_input(mesh, {}, Need::Smoothing, unwatched);
}

/// The mesh in ranks' shares; the partition is along a curve or by the vertices' numbers.
[[nodiscard]] inline SharedMesh shared(const World& world, const Mesh& mesh, PartitionChoice::Kind kind = PartitionChoice::Kind::Hilbert) {
  return share_block(world, block_of(world, mesh), "sample", {kind}, SharedVertexWords({}), Need::Smoothing);
}

}  // namespace dmoscope::testing
