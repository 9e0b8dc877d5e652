#pragma once
// Colour classes: vertices that may move at once because no two share an element.

#include <span>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/mesh/plane.h"
#include "core/mesh/topology.h"

namespace dmoscope {

class ThreadPool;

/// The free vertices in the order in which an iteration visits them, class after class.
struct Colouring {
  std::vector<Index> order;          // every free vertex once
  std::vector<Index> class_offsets;  // class c is order[class_offsets[c] .. class_offsets[c + 1])
  [[nodiscard]] Index class_count() const noexcept { return class_offsets.empty() ? 0 : static_cast<Index>(class_offsets.size() - 1); }
  [[nodiscard]] std::span<const Index> members(Index c) const noexcept {
    return {order.data() + class_offsets[c], order.data() + class_offsets[c + 1]};
  }
};

/// Greedy colouring in the order given: each vertex gets the lowest colour that no vertex sharing an ELEMENT with it has.
/// Within a class the vertices keep that order. `free_vertices`: distinct vertex indices. `followers`: by vertex, another vertex that moves
/// with it and is not free itself, or kNoIndex; empty: no followers. The result does not depend on the pool (null: this thread alone).
[[nodiscard]] Colouring colour_vertices(const Mesh& mesh, const Topology& topology, std::span<const Index> free_vertices,
                                        ThreadPool* pool = nullptr, std::span<const Index> followers = {});

/// Reorders every class, which changes no result since its members do not see each other: along a space-filling curve of `plane` (null: of
/// space), so that neighbours in space are neighbours in memory, and in stretches of it by the size of their stars, so that vertices that
/// are searched side by side need equal work. The result does not depend on the pool (null: this thread alone).
void arrange_classes(Colouring& colouring, const Mesh& mesh, const Plane* plane, const Topology& topology, ThreadPool* pool = nullptr);

/// Shuffles the vertices by `seed` with a generator of the program's own, so that the order is equal on every platform.
[[nodiscard]] std::vector<Index> shuffled(std::span<const Index> vertices, std::uint64_t seed);

}  // namespace dmoscope
