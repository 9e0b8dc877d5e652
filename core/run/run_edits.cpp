// Edits: visits of chosen vertices out of their turn.

#include <algorithm>

#include <fmt/format.h>

#include "core/reference/domain.h"
#include "core/run/run.h"

namespace dmoscope {

/// Ranks of free vertices in the run's order, ascending, each once. Throws UsageError for a vertex that cannot be visited.
std::vector<Index> Run::ranks_of(std::span<const Index> vertices) {
  if (rank_of_.empty()) {
    rank_of_.assign(input_->mesh.vertex_count(), kNoIndex);
    for (Index rank = 0; rank < colouring_->order.size(); ++rank) rank_of_[colouring_->order[rank]] = rank;
  }
  std::vector<Index> ranks;
  ranks.reserve(vertices.size());
  for (const Index vertex : vertices) {
    if (const std::string why = why_fixed(vertex); !why.empty())
      throw UsageError(fmt::format("vertex {} cannot be visited: {}", vertex, why));
    ranks.push_back(rank_of_[vertex]);
  }
  std::ranges::sort(ranks);
  ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
  return ranks;
}

std::string Run::why_fixed(Index vertex) const {
  if (vertex >= fixed().size()) return fmt::format("the mesh has {} vertices", fixed().size());
  if (fixed()[vertex] == 0) return {};
  if (input_->topology.star(vertex).empty()) return "it belongs to no element";
  if (parameters_.standing().layers == LayerRule::Keep && std::ranges::binary_search(input_->layers, vertex))
    return "it lies in a boundary layer, which is kept";
  if (domain_ && domain_->slides(vertex)) return "it was fixed by hand";
  if (input_->topology.boundary()[vertex] != 0 && parameters_.boundary == BoundaryRule::Fixed)
    return "it lies on the boundary, which stays";
  if (parameters_.interfaces != InterfaceRule::Free && input_->interfaces.holds(vertex)) return input_->interfaces.why(vertex);
  const std::string_view why = domain_ ? domain_->why_held(vertex) : std::string_view();
  return why.empty() ? "it was fixed by hand" : std::string(why);
}

/// Visits vertices (distinct, in the order of the visits), which makes one edit more; returns how many moved.
std::uint64_t Run::do_edit(std::span<const Index> vertices) {
  const std::vector<Index> ranks = ranks_of(vertices);
  std::uint64_t moved = 0;
  asking_device([&] {
    for (std::size_t first = 0, last = 0; first < ranks.size(); first = last) {
      do {
        ++last;
      } while (last < ranks.size() && ranks[last] == ranks[last - 1] + 1);
      moved += ask_smoother(ranks[first], last - first);
    }
  });
  ++at_.moment.edits;
  return moved;
}

std::uint64_t Run::visit_vertices(std::span<const Index> vertices, Progress& progress) {
  recover();
  const std::vector<Index> ranks = ranks_of(vertices);
  ensure_smoother();
  recovering([this] { download(); });
  keep();
  const bool one = ranks.size() <= Edit::kMostVertices;
  const std::vector<Vec3> positions_before =
      one ? std::vector<Vec3>{} : std::vector<Vec3>(positions_.host().begin(), positions_.host().end());
  const RunProgress before = at_;
  std::vector<Edit> edits;
  std::uint64_t moved = 0;
  try {
    for (std::size_t first = 0; first < ranks.size(); first += Edit::kMostVertices) {
      progress.check();
      progress.set(static_cast<double>(first) / static_cast<double>(ranks.size()));
      edits.push_back({at_.moment, {}});
      Edit& edit = edits.back();
      for (const Index rank : std::span(ranks).subspan(first, std::min(Edit::kMostVertices, ranks.size() - first)))
        edit.vertices.push_back(colouring_->order[rank]);
      moved += recovering([&] { return do_edit(edit.vertices); });
    }
  } catch (const DeviceError&) {  // the run has recovered
    throw;
  } catch (...) {
    if (at_.moment != before.moment) put(positions_before, before);
    throw;
  }
  if (edits.empty()) return 0;
  last_outcome_.reset();
  edits_.cut(before.moment);
  forget_after(before.moment.iteration);
  for (Edit& edit : edits) edits_.add(std::move(edit));
  ++path_;
  return moved;
}

void Run::adopt(const RunSnapshot& point, std::span<const Vec3> positions, Progress& progress) {
  std::uint64_t at_same_place = 0;
  for (const Edit *before = nullptr, *edit = point.edits.begin(); edit != point.edits.end(); before = edit++) {
    const bool same_place = before != nullptr && before->at.iteration == edit->at.iteration && before->at.visits == edit->at.visits;
    at_same_place = same_place ? at_same_place + 1 : 0;
    const bool later = before == nullptr || before->at < edit->at;
    if (!later || edit->at.edits != at_same_place || edit->at.visits >= visits_per_iteration())
      throw UsageError("visits of chosen vertices at moments that cannot be");
    const std::vector<Index> ranks = ranks_of(edit->vertices);
    const auto in_order = [&](Index rank, Index vertex) { return colouring_->order[rank] == vertex; };
    if (ranks.empty() || ranks.size() > Edit::kMostVertices ||
        !std::equal(ranks.begin(), ranks.end(), edit->vertices.begin(), edit->vertices.end(), in_order))
      throw UsageError("visits of chosen vertices in another order than this run's");
  }
  if (point.moment.iteration >= std::max<std::size_t>(1, point.records.size()))
    throw UsageError("the run stands at an iteration that has no record");
  edits_.replace(point.edits);
  ++path_;
  history_.restore_records(point.records);
  joint_course_.restore(point.joint);
  if (point.joint.standing && !joint_clusters().fits(point.joint.standing->state))
    throw UsageError("what joint moves know is of another mesh or of other fixed vertices");
  if (point.moment.iteration > 0) {
    history_.hold(point.moment.iteration, positions, pool_.get());
  }
  seek(point.moment, progress);
}

void Run::reset(Progress& progress) {
  seek({}, progress);
  if (edits_.all().empty()) return;
  forget_after(edits_.all().front().at.iteration);
  edits_.cut({});
  ++path_;
}

}  // namespace dmoscope
