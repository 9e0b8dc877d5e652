#include "gpu/device_mesh.h"

#include <array>
#include <numeric>
#include <utility>

#include "core/base/memory.h"
#include "gpu/bodies.h"

namespace dmoscope::gpu {

namespace {

std::vector<std::uint8_t> flags(std::size_t size, std::span<const Index> set) {
  std::vector<std::uint8_t> result(size, 0);
  for (const Index i : set) result[i] = 1;
  return result;
}

/// Makes the table of ranks and stars; the stars of volumes are left out.
StarTable star_table_of(const InputMesh& input, const Colouring& colouring, ThreadPool* pool) {
  if (!input.is_volume()) return build_star_table(input.mesh, input.topology, colouring, pool);
  StarTable table;
  const std::size_t vertices = input.mesh.positions.size();
  table.vertex_of_rank.reserve(vertices);
  table.vertex_of_rank.assign(colouring.order.begin(), colouring.order.end());
  table.rank_of_vertex.assign(vertices, kNoIndex);
  for (Index rank = 0; rank < table.vertex_of_rank.size(); ++rank) table.rank_of_vertex[table.vertex_of_rank[rank]] = rank;
  for (Index v = 0; v < vertices; ++v) {
    if (table.rank_of_vertex[v] != kNoIndex) continue;
    table.rank_of_vertex[v] = static_cast<Index>(table.vertex_of_rank.size());
    table.vertex_of_rank.push_back(v);
  }
  return table;
}

/// Number of parts of the statistics, including the totals.
std::size_t part_count(std::size_t elements) { return ((elements + bodies::kStretch - 1) / bodies::kStretch + 1) * bodies::kParts; }

}  // namespace

DeviceMesh::DeviceMesh(std::shared_ptr<Queue> queue, const InputMesh& input, const Colouring& colouring, std::span<const Index> immovable,
                       ThreadPool* pool)
    : DeviceMesh(std::move(queue), input, colouring, star_table_of(input, colouring, pool), immovable, pool) {}

DeviceMesh::DeviceMesh(std::shared_ptr<Queue> queue, const InputMesh& input, const Colouring& colouring, const StarTable& table,
                       std::span<const Index> immovable, ThreadPool* pool)
    : queue_(std::move(queue)),
      shapes_(queue_, table.shapes, pool),
      others_(queue_, table.others, pool),
      star_offsets_(queue_, input.topology.star_offsets(), pool),
      incidences_(queue_, input.topology.incidences(), pool),
      corner_offsets_(queue_, input.mesh.elements.offsets(), pool),
      corners_(queue_, input.mesh.elements.all_corners(), pool),
      reference_measure_(queue_, input.reference_measure, pool),
      rank_of_vertex_(queue_, table.rank_of_vertex, pool),
      vertex_of_rank_(queue_, table.vertex_of_rank, pool),
      positions_(queue_, input.mesh.positions.size()),
      ranked_(queue_, input.mesh.positions.size()),
      awake_(queue_, input.mesh.positions.size()),
      inverted_(queue_, input.mesh.elements.size()),
      immovable_(queue_, flags(input.mesh.elements.size(), immovable), pool),
      quality_(queue_, input.mesh.elements.size()),
      parts_(queue_, part_count(input.mesh.elements.size())),
      statistics_(queue_, 1),
      fetched_(queue_),
      is_volume_(input.is_volume()) {
  task_.shapes = shapes_.data();
  task_.others = others_.data();
  task_.mesh = {star_offsets_.data(), incidences_.data(),        corner_offsets_.data(),
                corners_.data(),      reference_measure_.data(), input.geometry.plane};
  task_.rank_of_vertex = rank_of_vertex_.data();
  task_.vertex_of_rank = vertex_of_rank_.data();
  task_.vertex_count = positions_.size();
  task_.element_count = quality_.size();
  task_.ranked = ranked_.data();
  task_.awake = awake_.data();
  task_.frame = make_search_frame(input);
  task_.quality = quality_.data();
  task_.inverted = inverted_.data();
  task_.immovable = immovable_.data();
  task_.parts = parts_.data();
  task_.statistics = statistics_.data();
  task_.positions = positions_.data();
  if (!is_volume_) list_stars(colouring, table, pool);
}

void DeviceMesh::list_stars(const Colouring& colouring, const StarTable& table, ThreadPool* pool) {
  constexpr std::array<std::size_t, 9> kPlaceOfFan{5, 5, 5, 5, 2,
                                                   1, 0, 4, 3};  // by its triangles: the dearest first, so that none is left to the end
  constexpr std::size_t kSizes = 5;
  const auto place_of = [&](Index rank) {
    const StarShape& shape = table.shapes[rank];
    return kind_of_star<Metric::MeanRatio>(shape, {}) == Stars::Others ? kSizes : kPlaceOfFan[shape.triangles];
  };
  auto ranks = large_vector<Index>(colouring.order.size());
  classes_.resize(colouring.class_count());
  for_chunks(pool, classes_.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t c = first; c < last; ++c) {
      const Index begin = colouring.class_offsets[c], end = colouring.class_offsets[c + 1];
      std::array<std::size_t, kSizes + 1> count{}, next{};
      for (Index rank = begin; rank < end; ++rank) ++count[place_of(rank)];
      std::exclusive_scan(count.begin(), count.end(), next.begin(), std::size_t{begin});
      for (Index rank = begin; rank < end; ++rank) ranks[next[place_of(rank)]++] = rank;
      classes_[c] = {nullptr, count[0] + count[1] + count[2], count[3] + count[4], count[kSizes]};
    }
  });
  listed_ = Buffer<Index>(queue_, ranks, pool);
  for (Index c = 0; c < colouring.class_count(); ++c) classes_[c].ranks = listed_.data() + colouring.class_offsets[c];
}

void DeviceMesh::judge(Metric metric) {
  queue_->launch(is_volume_ ? Work::JudgeVolume : Work::Judge, metric, task_, task_.element_count);
  add_up();
}

void DeviceMesh::add_up() {
  queue_->launch(Work::Sum, kNoMetric, task_, parts_.size() - bodies::kParts);
  queue_->launch(Work::Total, kNoMetric, task_, bodies::kParts);
  queue_->launch(Work::Conclude, kNoMetric, task_, 1);
  fetched_.fetch(statistics_.data());
}

Statistics DeviceMesh::statistics() const {
  queue_->wait();
  return fetched_.value();
}

}  // namespace dmoscope::gpu
