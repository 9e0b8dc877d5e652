#pragma once
// Smoother of one rank's share that keeps the others' vertices up to date.

#include <memory>
#include <vector>

#include "core/smooth/smoother.h"
#include "mpi/mesh/halo.h"

namespace dmoscope {

/// Division of a rank's visits: each colour class of the mesh is two classes of its colouring, first the vertices that others wait for.
struct HaloPlan {
  /// Exchange of one class of the mesh.
  struct Exchange {
    struct With {
      int rank;
      std::uint64_t send_begin, send_end, receive_begin, receive_end;  // indices into send and receive
    };
    std::vector<With> neighbours;  // ranks with which vertices are exchanged
    std::vector<Index> send, receive;
  };
  std::vector<Exchange> classes;
  /// Bytes that all exchanges of an iteration send.
  [[nodiscard]] std::uint64_t bytes() const;
};

/// Time of a rank's visits so far.
struct HaloCost {
  double visiting = 0.0;  // processor seconds of all its threads in visits
  double waiting = 0.0;   // seconds in exchanges, or waiting for others
};

/// Makes the plan. `colour`: by vertex, see SharedColours; `classes`: of the mesh.
[[nodiscard]] HaloPlan make_halo_plan(const Halo& halo, std::span<const Index> colour, Index classes);

/// Makes the smoother. `here`: the smoother of the share's own vertices, `colouring`: its order, in two classes for each of the plan's.
/// `cost`: is added to. Plan and cost must outlive it.
[[nodiscard]] std::unique_ptr<Smoother> make_halo_smoother(const World& world, const HaloPlan& plan, std::unique_ptr<Smoother> here,
                                                           std::shared_ptr<const Colouring> colouring, HaloCost& cost);

}  // namespace dmoscope
