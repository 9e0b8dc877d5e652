#pragma once
// A rank's share of a mesh, by the interface that core uses.

#include <memory>
#include <vector>

#include "core/input/mesh_share.h"
#include "core/smooth/smoother.h"
#include "mpi/mesh/share.h"
#include "mpi/mesh/shared_colouring.h"
#include "mpi/smooth/shared_statistics.h"

namespace dmoscope {

// Smoother of one rank's share that keeps the others' vertices up to date.

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

class RankShare final : public MeshShare {
 public:
  /// Takes all of the share but its mesh; all ranks together.
  RankShare(const World& world, Share share);

  [[nodiscard]] std::uint64_t element_count() const noexcept override { return share_.element_count; }
  [[nodiscard]] std::uint64_t vertex_count() const noexcept { return share_.vertex_count; }
  [[nodiscard]] bool owns(Index vertex) const noexcept override { return share_.owner[vertex] == world_.rank(); }
  [[nodiscard]] bool counts(Index element) const noexcept override { return share_.home[element] != 0; }
  [[nodiscard]] std::span<const std::uint64_t> vertex_numbers() const noexcept override { return share_.vertices; }
  [[nodiscard]] std::span<const std::uint64_t> element_numbers() const noexcept override { return share_.elements; }
  void agree(std::span<std::uint8_t> values) const override { halo_.agree(values); }
  void agree(std::span<double> values) const override { halo_.agree(values); }
  [[nodiscard]] bool any(bool here) const override { return world_.any(here); }
  [[nodiscard]] double greatest(double here) const override { return world_.greatest(here); }
  [[nodiscard]] std::uint64_t sum(std::uint64_t here) const override { return world_.sum(here); }
  [[nodiscard]] std::vector<std::string> all_of(const std::string& here) const override;
  void join(RegionParts& parts) const override;
  Index orient(Mesh& mesh, const Geometry& geometry, const Topology& topology, const FaceNeighbours* faces) const override;
  [[nodiscard]] Colouring colour(const Mesh& mesh, const Geometry& geometry, const Topology& topology, std::span<const std::uint8_t> fixed,
                                 ThreadPool* pool) const override;
  [[nodiscard]] std::unique_ptr<Smoother> among_others(std::unique_ptr<Smoother> here, const SmoothingTask& task) const override;
  [[nodiscard]] Statistics statistics(const QualityContext& context, std::span<const Vec3> positions, Metric metric,
                                      std::span<const Index> immovable, ThreadPool* pool) const override;

  [[nodiscard]] const World& world() const noexcept { return world_; }
  [[nodiscard]] const Share& share() const noexcept { return share_; }
  [[nodiscard]] const Halo& halo() const noexcept { return halo_; }
  [[nodiscard]] const SharedStatistics& sums() const noexcept { return statistics_; }
  /// Figures of the last colour(): bytes that an iteration sends from here, classes of the mesh, rounds of the colouring.
  [[nodiscard]] std::uint64_t bytes_sent() const { return plan_.bytes(); }
  /// Time of all smoothers so far.
  [[nodiscard]] const HaloCost& cost() const noexcept { return cost_; }
  [[nodiscard]] Index classes() const noexcept { return colours_.classes; }
  [[nodiscard]] std::uint64_t rounds() const noexcept { return colours_.rounds; }

 private:
  World world_;
  Share share_;
  Halo halo_;
  SharedStatistics statistics_;
  mutable SharedColours colours_;
  mutable HaloPlan plan_;
  mutable HaloCost cost_;
};

}  // namespace dmoscope
