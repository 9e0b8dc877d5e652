#include "mpi/smooth/shared_left_inverted.h"

#include <algorithm>
#include <tuple>
#include <vector>

namespace dmoscope {
namespace {

struct Element {
  double jacobian = 0.0;
  WholeIndex number = ~WholeIndex{0};
  bool inside_alone = false;
  Vec3 inside{};  // the place inside, if inside_alone
};
struct Vertex {
  std::uint64_t around = 0, fixed = 0;
  WholeIndex number = ~WholeIndex{0};
  Vec3 place{};
  /// Whether it is a better example than another.
  [[nodiscard]] bool before(const Vertex& other) const {
    return std::tuple(other.around, other.fixed, number) < std::tuple(around, fixed, other.number);
  }
};

Index as_index(WholeIndex number) { return number < kNoIndex ? static_cast<Index>(number) : kNoIndex; }

}  // namespace

InvertedCount count_inverted(const QualityContext& context, PositionView positions, const RankShare& share) {
  InvertedCount here;
  for (Index e = 0; e < context.mesh.elements.size(); ++e)
    if (share.share().home[e] != 0) here.add(context, positions, e, share.share().elements[e]);
  const World& world = share.world();
  InvertedCount all{world.sum(here.all), world.sum(here.inside_alone), world.gather(here.first)};
  std::ranges::sort(all.first, {}, &InvertedCount::Element::number);
  all.first.resize(std::min(all.first.size(), InvertedCount::kMostNamed));
  world.broadcast(all.first, 0);
  return all;
}

std::optional<LeftInverted> find_left_inverted(const Run& run, const RankShare& share) {
  const InputMesh& input = run.input();
  const QualityContext context = input.quality_context();
  const auto positions = run.positions();
  const World& world = share.world();
  InvertedCount all = count_inverted(context, positions, share);
  if (all.all == 0) return std::nullopt;
  Element worst;
  std::vector<Index> around(positions.size());
  for (Index e = 0; e < input.mesh.elements.size(); ++e) {
    const double jacobian = smallest_jacobian(context, positions, e) / input.reference_measure[e];
    if (!(jacobian <= 0.0)) continue;
    for (const Index v : input.mesh.elements.corners(e)) ++around[v];
    if (share.share().home[e] == 0) continue;
    if (worst.number != Element{}.number && !(jacobian < worst.jacobian)) continue;
    const std::optional<Vec3> inside = inverted_inside(context, positions, e);
    worst = {jacobian, share.share().elements[e], inside.has_value(), inside.value_or(Vec3{})};
  }
  Vertex first;
  Index here = kNoIndex;
  for (Index v = 0; v < around.size(); ++v) {
    if (!share.owns(v)) continue;
    const Vertex vertex{around[v], run.fixed()[v], share.share().vertices[v], positions[v]};
    if (here != kNoIndex && !vertex.before(first)) continue;
    first = vertex;
    here = v;
  }
  for (const Element& one : world.all_of(worst))
    if (one.number != Element{}.number &&
        (worst.number == Element{}.number || std::tuple(one.jacobian, one.number) < std::tuple(worst.jacobian, worst.number)))
      worst = one;
  int owner = 0;
  const std::vector<Vertex> firsts = world.all_of(first);
  for (int rank = 1; rank < world.size(); ++rank)
    if (firsts[static_cast<std::size_t>(rank)].before(firsts[static_cast<std::size_t>(owner)])) owner = rank;
  std::string why = owner == world.rank() ? run.why_fixed(here) : std::string();
  world.broadcast(why, owner);
  const Vertex& vertex = firsts[static_cast<std::size_t>(owner)];
  LeftInverted found;
  found.all = std::move(all);
  found.element = as_index(worst.number);
  if (worst.inside_alone) found.inside = worst.inside;
  found.vertex = as_index(vertex.number);
  found.around = static_cast<Index>(vertex.around);
  found.place = vertex.place;
  found.why_fixed = std::move(why);
  return found;
}

}  // namespace dmoscope
