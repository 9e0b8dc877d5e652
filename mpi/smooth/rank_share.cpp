#include "mpi/smooth/rank_share.h"

#include <utility>

#include "core/input/mesh_region.h"
#include "core/smooth/task.h"
#include "mpi/mesh/shared_winding.h"

namespace dmoscope {

RankShare::RankShare(const World& world, Share share)
    : world_(world), share_(std::move(share)), halo_(world, share_), statistics_(world, share_) {}

void RankShare::join(RegionParts& parts) const {
  const auto on_all = [this](auto& values) {
    values = world_.gather(values);
    world_.broadcast(values, 0);
  };
  on_all(parts.vertices);
  on_all(parts.elements);
}

Index RankShare::orient(Mesh& mesh, const Geometry& geometry, const Topology& topology, const FaceNeighbours* faces) const {
  return orient_share(world_, share_, mesh, geometry, topology, faces);
}

Colouring RankShare::colour(const Mesh& mesh, const Geometry& geometry, const Topology& topology, std::span<const std::uint8_t> fixed,
                            ThreadPool* pool) const {
  colours_ = colour_shares(world_, share_, halo_, mesh, topology, fixed);
  plan_ = make_halo_plan(halo_, colours_.of_vertex, colours_.classes);
  std::vector<std::uint8_t> awaited(share_.vertices.size(), 0);
  for (const Halo::Neighbour& neighbour : halo_.neighbours())
    for (const Index v : neighbour.send) awaited[v] = 1;
  // Counting sort by class; within a class, vertices that others wait for come first.
  Colouring colouring;
  colouring.class_offsets.assign(2 * std::size_t{colours_.classes} + 1, 0);
  const auto part = [&](Index v) { return 2 * std::size_t{colours_.of_vertex[v]} + (awaited[v] != 0 ? 0U : 1U); };
  const auto each = [&](const auto& visit) {
    for (Index v = 0; v < fixed.size(); ++v)
      if (fixed[v] == 0 && owns(v)) visit(v);
  };
  each([&](Index v) { ++colouring.class_offsets[part(v) + 1]; });
  for (std::size_t c = 1; c < colouring.class_offsets.size(); ++c) colouring.class_offsets[c] += colouring.class_offsets[c - 1];
  colouring.order.resize(colouring.class_offsets.back());
  std::vector<Index> next(colouring.class_offsets.begin(), colouring.class_offsets.end() - 1);
  each([&](Index v) { colouring.order[next[part(v)]++] = v; });
  arrange_classes(colouring, mesh, geometry.shape == Shape::Volume ? nullptr : &geometry.plane, topology, pool);
  return colouring;
}

std::unique_ptr<Smoother> RankShare::among_others(std::unique_ptr<Smoother> here, const SmoothingTask& task) const {
  return make_halo_smoother(world_, plan_, std::move(here), task.colouring, cost_);
}

Statistics RankShare::statistics(const QualityContext& context, std::span<const Vec3> positions, Metric metric,
                                 std::span<const Index> immovable, ThreadPool* pool) const {
  return statistics_.of(context, positions, metric, immovable, pool);
}

}  // namespace dmoscope
