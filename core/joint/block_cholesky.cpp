#include "core/joint/block_cholesky.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dmoscope {

namespace {

constexpr std::size_t kLeaf = 8;  // parts of as many vertices are not halved any more

enum class Side : std::uint8_t { Outside, First, Second, Unseen, Seen };

struct Halves {
  std::vector<Index> first, second, separator;
};

/// The first half of the vertices in `order` and the second one; those of the first with a neighbour in the second separate them.
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

/// The vertices of a part by distance from `start`; parts that do not hang together one after the other.
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
    // From one end of the part: the last that a search finds is far from where it began.
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

template <int D>
BlockCholesky<D>::BlockCholesky(const Adjacency& graph, std::span<const std::array<double, D>> places)
    : order_(nested_dissection<D>(graph, places)), place_(order_.size()) {
  for (std::size_t i = 0; i < order_.size(); ++i) place_[order_[i]] = static_cast<Index>(i);
  index_rows(graph);
  find_tree();
  const std::size_t n = order_.size();
  stack_.resize(n);
  path_.resize(n);
  spread_.resize(n);
  permuted_.resize(n * kD);
}

template <int D>
void BlockCholesky<D>::index_rows(const Adjacency& graph) {
  row_offsets_.assign(1, 0);
  for (std::size_t i = 0; i < order_.size(); ++i) {
    for (const Index w : graph.of(order_[i]))
      if (place_[w] < i) columns_.push_back(place_[w]);
    std::sort(columns_.begin() + row_offsets_.back(), columns_.end());
    row_offsets_.push_back(static_cast<Index>(columns_.size()));
  }
  values_.resize(order_.size() + columns_.size());
  factor_diagonal_.resize(order_.size());
}

template <int D>
void BlockCholesky<D>::find_tree() {
  const std::size_t n = order_.size();
  parent_.assign(n, kNoIndex);
  std::vector<Index> ancestor(n, kNoIndex);
  for (Index i = 0; i < n; ++i)
    for (Index p = row_offsets_[i]; p < row_offsets_[i + 1]; ++p)
      for (Index k = columns_[p]; k != kNoIndex && k < i;) {
        const Index next = ancestor[k];
        ancestor[k] = i;
        if (next == kNoIndex) parent_[k] = i;
        k = next;
      }
  std::vector<std::size_t> count(n, 0);
  mark_.assign(n, kNoIndex);
  for (Index i = 0; i < n; ++i) {
    mark_[i] = i;
    for (Index p = row_offsets_[i]; p < row_offsets_[i + 1]; ++p)
      for (Index k = columns_[p]; mark_[k] != i; k = parent_[k]) {
        ++count[k];
        mark_[k] = i;
      }
  }
  column_offsets_.assign(n + 1, 0);
  for (std::size_t i = 0; i < n; ++i) column_offsets_[i + 1] = column_offsets_[i] + count[i];
  factor_rows_.resize(column_offsets_[n]);
  factor_.resize(column_offsets_[n]);
}

template <int D>
typename BlockCholesky<D>::Slot BlockCholesky<D>::slot(Index i, Index j) const {
  const Index row = place_[i], column = place_[j];
  if (row == column) return {row, false};
  const Index low = std::min(row, column), high = std::max(row, column);
  const auto first = columns_.begin() + row_offsets_[high], last = columns_.begin() + row_offsets_[high + 1];
  const auto at = std::lower_bound(first, last, low) - columns_.begin();
  return {static_cast<Index>(order_.size() + static_cast<std::size_t>(at)), row < column};
}

template <int D>
void BlockCholesky<D>::clear() {
  std::ranges::fill(values_, Block{});
}

template <int D>
void BlockCholesky<D>::add(Slot slot, const Block& block) {
  Block& to = values_[slot.block];
  for (std::size_t r = 0; r < kD; ++r)
    for (std::size_t c = 0; c < kD; ++c) to[r * kD + c] += slot.transposed ? block[c * kD + r] : block[r * kD + c];
}

template <int D>
bool BlockCholesky<D>::factorise() {
  const std::size_t n = order_.size();
  filled_.assign(column_offsets_.begin(), column_offsets_.end() - 1);
  mark_.assign(n, kNoIndex);
  std::ranges::fill(spread_, Block{});
  for (Index i = 0; i < n; ++i)
    if (!factorise_row(i, reach(i))) return false;
  return true;
}

template <int D>
std::size_t BlockCholesky<D>::reach(Index i) {
  std::size_t top = order_.size();
  mark_[i] = i;
  for (Index p = row_offsets_[i]; p < row_offsets_[i + 1]; ++p) {
    Index k = columns_[p];
    spread_[k] = values_[order_.size() + p];
    std::size_t length = 0;
    for (; mark_[k] != i; k = parent_[k]) {
      path_[length++] = k;
      mark_[k] = i;
    }
    while (length > 0) stack_[--top] = path_[--length];
  }
  return top;
}

template <int D>
bool BlockCholesky<D>::factorise_row(Index i, std::size_t top) {
  Block d = values_[i];
  for (; top < order_.size(); ++top) {
    const Index k = stack_[top];
    Block l = spread_[k];
    spread_[k] = Block{};
    const Block& corner = factor_diagonal_[k];
    for (std::size_t c = 0; c < kD; ++c)  // l := l corner^-T
      for (std::size_t r = 0; r < kD; ++r) {
        for (std::size_t e = 0; e < c; ++e) l[r * kD + c] -= l[r * kD + e] * corner[c * kD + e];
        l[r * kD + c] /= corner[c * kD + c];
      }
    for (std::size_t p = column_offsets_[k]; p < filled_[k]; ++p) {
      Block& w = spread_[factor_rows_[p]];
      const Block& m = factor_[p];
      for (std::size_t r = 0; r < kD; ++r)
        for (std::size_t c = 0; c < kD; ++c)
          for (std::size_t e = 0; e < kD; ++e) w[r * kD + c] -= l[r * kD + e] * m[c * kD + e];
    }
    for (std::size_t r = 0; r < kD; ++r)
      for (std::size_t c = 0; c < kD; ++c)
        for (std::size_t e = 0; e < kD; ++e) d[r * kD + c] -= l[r * kD + e] * l[c * kD + e];
    factor_rows_[filled_[k]] = i;
    factor_[filled_[k]++] = l;
  }
  for (std::size_t c = 0; c < kD; ++c) {
    for (std::size_t r = c; r < kD; ++r)
      for (std::size_t e = 0; e < c; ++e) d[r * kD + c] -= d[r * kD + e] * d[c * kD + e];
    if (!(d[c * kD + c] > 0.0) || !std::isfinite(d[c * kD + c])) return false;
    const double root = std::sqrt(d[c * kD + c]);
    for (std::size_t r = c; r < kD; ++r) d[r * kD + c] /= root;
  }
  factor_diagonal_[i] = d;
  return true;
}

template <int D>
void BlockCholesky<D>::solve(std::span<double> b) const {
  const std::size_t n = order_.size();
  std::vector<double>& y = permuted_;
  for (std::size_t i = 0; i < n; ++i) std::copy_n(b.data() + order_[i] * kD, kD, y.data() + i * kD);
  for (std::size_t k = 0; k < n; ++k) {
    double* v = y.data() + k * kD;
    const Block& l = factor_diagonal_[k];
    for (std::size_t c = 0; c < kD; ++c) {
      for (std::size_t e = 0; e < c; ++e) v[c] -= l[c * kD + e] * v[e];
      v[c] /= l[c * kD + c];
    }
    for (std::size_t p = column_offsets_[k]; p < column_offsets_[k + 1]; ++p) {
      double* w = y.data() + factor_rows_[p] * kD;
      for (std::size_t r = 0; r < kD; ++r)
        for (std::size_t c = 0; c < kD; ++c) w[r] -= factor_[p][r * kD + c] * v[c];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    double* v = y.data() + k * kD;
    for (std::size_t p = column_offsets_[k]; p < column_offsets_[k + 1]; ++p) {
      const double* w = y.data() + factor_rows_[p] * kD;
      for (std::size_t r = 0; r < kD; ++r)
        for (std::size_t c = 0; c < kD; ++c) v[r] -= factor_[p][c * kD + r] * w[c];
    }
    const Block& l = factor_diagonal_[k];
    for (std::size_t c = kD; c-- > 0;) {
      for (std::size_t e = c + 1; e < kD; ++e) v[c] -= l[e * kD + c] * v[e];
      v[c] /= l[c * kD + c];
    }
  }
  for (std::size_t i = 0; i < n; ++i) std::copy_n(y.data() + i * kD, kD, b.data() + order_[i] * kD);
}

template class BlockCholesky<2>;
template class BlockCholesky<3>;

}  // namespace dmoscope
