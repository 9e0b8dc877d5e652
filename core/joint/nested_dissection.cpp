#include "core/joint/nested_dissection.h"

#include <algorithm>
#include <numeric>

namespace dmoscope {

Adjacency adjacency_of(std::vector<std::vector<Index>> neighbours) {
  Adjacency graph;
  for (std::vector<Index>& each : neighbours) {
    std::sort(each.begin(), each.end());
    each.erase(std::unique(each.begin(), each.end()), each.end());
    graph.neighbours.insert(graph.neighbours.end(), each.begin(), each.end());
    graph.offsets.push_back(static_cast<Index>(graph.neighbours.size()));
  }
  return graph;
}

namespace {

constexpr std::size_t kLeaf = 8;  // parts of so many vertices are not halved any more

enum class Side : std::uint8_t { Outside, First, Second, Unseen, Seen };

struct Halves {
  std::vector<Index> first, second, separator;
};

/// Halves of the vertices in `order`; those of the first with a neighbour in the second separate them.
Halves halved(const Adjacency& graph, const std::vector<Index>& order, std::vector<Side>& side) {
  const std::size_t half = order.size() / 2;
  for (std::size_t i = 0; i < order.size(); ++i) side[order[i]] = i < half ? Side::First : Side::Second;
  Halves result;
  for (std::size_t i = 0; i < half; ++i) {
    const auto neighbours = graph.of(order[i]);
    const bool touches = std::ranges::any_of(neighbours, [&](Index w) { return side[w] == Side::Second; });
    (touches ? result.separator : result.first).push_back(order[i]);
  }
  result.second.assign(order.begin() + static_cast<std::ptrdiff_t>(half), order.end());
  for (const Index v : order) side[v] = Side::Outside;
  return result;
}

/// Vertices of a part by distance from `start`; parts that are not connected one after the other.
std::vector<Index> breadth_first(const Adjacency& graph, const std::vector<Index>& part, Index start, std::vector<Side>& side) {
  for (const Index v : part) side[v] = Side::Unseen;
  std::vector<Index> queue{start};
  queue.reserve(part.size());
  side[start] = Side::Seen;
  for (std::size_t at = 0, next = 0; at < part.size(); ++at) {
    if (at == queue.size()) {
      while (side[part[next]] == Side::Seen) ++next;
      queue.push_back(part[next]);
      side[part[next]] = Side::Seen;
    }
    for (const Index w : graph.of(queue[at])) {
      if (side[w] != Side::Unseen) continue;
      side[w] = Side::Seen;
      queue.push_back(w);
    }
  }
  for (const Index v : part) side[v] = Side::Outside;
  return queue;
}

template <int D>
class Dissection {
 public:
  Dissection(const Adjacency& graph, std::span<const std::array<double, D>> places)
      : graph_(graph), places_(places), side_(places.size(), Side::Outside) {
    order.reserve(places.size());
  }
  void dissect(std::vector<Index> part) {
    if (part.size() <= kLeaf) return leave(part);
    std::vector<Index> sorted = by_longest_coordinate(part);
    Halves best = halved(graph_, sorted, side_);
    // Begins at one end of the part: the last vertex that a search finds is far from its start.
    std::vector<Index> queue = std::move(sorted);
    for (int search = 0; search < 3; ++search) queue = breadth_first(graph_, part, search == 0 ? queue.front() : queue.back(), side_);
    Halves other = halved(graph_, queue, side_);
    if (best.first.empty() || other.separator.size() < best.separator.size()) best = std::move(other);
    if (2 * best.separator.size() > part.size()) return leave(part);
    part.clear();
    part.shrink_to_fit();
    dissect(std::move(best.first));
    dissect(std::move(best.second));
    leave(best.separator);
  }
  std::vector<Index> order;

 private:
  void leave(const std::vector<Index>& part) { order.insert(order.end(), part.begin(), part.end()); }
  [[nodiscard]] std::vector<Index> by_longest_coordinate(const std::vector<Index>& part) const {
    std::array<double, D> low = places_[part[0]], high = low;
    for (const Index v : part)
      for (std::size_t r = 0; r < low.size(); ++r) {
        low[r] = std::min(low[r], places_[v][r]);
        high[r] = std::max(high[r], places_[v][r]);
      }
    std::size_t axis = 0;
    for (std::size_t r = 1; r < low.size(); ++r)
      if (high[r] - low[r] > high[axis] - low[axis]) axis = r;
    std::vector<Index> sorted = part;
    std::ranges::sort(sorted,
                      [&](Index a, Index b) { return places_[a][axis] != places_[b][axis] ? places_[a][axis] < places_[b][axis] : a < b; });
    return sorted;
  }
  const Adjacency& graph_;
  std::span<const std::array<double, D>> places_;
  std::vector<Side> side_;
};

}  // namespace

template <int D>
std::vector<Index> nested_dissection(const Adjacency& graph, std::span<const std::array<double, D>> places) {
  Dissection<D> dissection(graph, places);
  std::vector<Index> all(places.size());
  std::iota(all.begin(), all.end(), Index{0});
  dissection.dissect(std::move(all));
  return std::move(dissection.order);
}
template std::vector<Index> nested_dissection<2>(const Adjacency&, std::span<const std::array<double, 2>>);
template std::vector<Index> nested_dissection<3>(const Adjacency&, std::span<const std::array<double, 3>>);

}  // namespace dmoscope
