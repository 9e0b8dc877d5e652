#include "core/joint/block_cholesky.h"

#include <algorithm>

#include "core/joint/dense_solve.h"

namespace dmoscope {

template <int D>
BlockCholesky<D>::BlockCholesky(const Adjacency& graph, std::span<const std::array<double, D>> places, SimdLevel level)
    : level_(level), tree_(find_supernodes(graph, nested_dissection<D>(graph, places))), place_(tree_.order.size()) {
  for (std::size_t k = 0; k < tree_.order.size(); ++k) place_[tree_.order[k]] = static_cast<Index>(k);
  index_columns(graph);
  place_fronts();
}

template <int D>
void BlockCholesky<D>::index_columns(const Adjacency& graph) {
  column_offsets_.assign(1, 0);
  for (const Supernode& node : tree_.nodes)
    for (Index k = node.first; k < node.end; ++k) {
      for (const Index w : graph.of(tree_.order[k]))
        if (place_[w] > k) rows_.push_back(place_[w]);
      std::sort(rows_.begin() + column_offsets_.back(), rows_.end());
      auto at = tree_.rows.begin() + static_cast<std::ptrdiff_t>(node.rows);
      for (std::size_t p = column_offsets_.back(); p < rows_.size(); ++p) {
        while (rows_[p] >= node.end && *at != rows_[p]) ++at;
        const auto below = static_cast<std::size_t>(at - tree_.rows.begin()) - node.rows;
        front_rows_.push_back(rows_[p] < node.end ? rows_[p] - node.first : static_cast<Index>(node.width() + below));
      }
      column_offsets_.push_back(static_cast<Index>(rows_.size()));
    }
  values_.resize(tree_.order.size() + rows_.size());
}

/// Rests go to two stacks, by whether their depth in the tree is even: when a front is begun its children's are on top of the one, and its
/// own goes to the other.
template <int D>
void BlockCholesky<D>::place_fronts() {
  const std::size_t n = tree_.nodes.size();
  places_.resize(n);
  children_.resize(n);
  std::vector<std::size_t> depth(n, 0);
  for (std::size_t s = n; s-- > 0;)
    if (tree_.nodes[s].parent != kNoIndex) depth[s] = depth[tree_.nodes[s].parent] + 1;
  std::array<std::size_t, 2> top{}, most{};
  std::size_t pivots = 0;
  for (std::size_t s = 0; s < n; ++s) {
    const Supernode& node = tree_.nodes[s];
    const std::size_t rest = node.below() * node.below() * kD * kD, stack = depth[s] % 2;
    places_[s] = {pivots, top[stack]};
    pivots += node.height() * node.width() * kD * kD;
    top[stack] += rest;
    most[stack] = std::max(most[stack], top[stack]);
    if (!children_[s].empty()) top[1 - stack] = places_[children_[s].front()].rest;
    if (node.parent != kNoIndex) children_[node.parent].push_back(static_cast<Index>(s));
  }
  for (std::size_t s = 0; s < n; ++s)
    if (depth[s] % 2 == 1) places_[s].rest += most[0];
  factor_.resize(pivots);
  rests_.resize(most[0] + most[1]);
}

template <int D>
typename BlockCholesky<D>::Slot BlockCholesky<D>::slot(Index i, Index j) const {
  const Index row = place_[i], column = place_[j];
  if (row == column) return {row, false};
  const Index low = std::min(row, column), high = std::max(row, column);
  const auto first = rows_.begin() + column_offsets_[low], last = rows_.begin() + column_offsets_[low + 1];
  const auto at = std::lower_bound(first, last, high) - rows_.begin();
  return {static_cast<Index>(tree_.order.size() + static_cast<std::size_t>(at)), row < column};
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
std::size_t BlockCholesky<D>::factor_blocks() const noexcept {
  std::size_t count = 0;
  for (const Supernode& node : tree_.nodes) count += node.width() * (node.width() - 1) / 2 + node.width() * node.below();
  return count;
}

template <int D>
DenseFront BlockCholesky<D>::front(std::size_t s) {
  const Supernode& node = tree_.nodes[s];
  return {node.height() * kD, node.width() * kD, factor_.data() + places_[s].pivots, rests_.data() + places_[s].rest};
}

template <int D>
bool BlockCholesky<D>::factorise() {
  for (std::size_t s = 0; s < tree_.nodes.size(); ++s)
    if (!factorise_front(s)) return false;
  return true;
}

template <int D>
bool BlockCholesky<D>::factorise_front(std::size_t s) {
  const DenseFront dense = front(s);
  start_front(s, dense);
  for (const Index child : children_[s]) add_rest(child, dense);
  return eliminate(dense, room_, level_);
}

/// With the matrix's columns.
template <int D>
void BlockCholesky<D>::start_front(std::size_t s, const DenseFront& dense) const {
  const Supernode& node = tree_.nodes[s];
  std::fill_n(dense.pivots, dense.height * dense.width, 0.0);
  for (std::size_t j = dense.width; j < dense.height; ++j) std::fill(dense.column(j) + j, dense.column(j) + dense.height, 0.0);
  for (std::size_t k = node.first; k < node.end; ++k) {
    const std::size_t column = (k - node.first) * kD;
    const auto put = [&](const Block& block, std::size_t row) {
      for (std::size_t c = 0; c < kD; ++c)
        for (std::size_t r = 0; r < kD; ++r) dense.column(column + c)[row * kD + r] = block[r * kD + c];
    };
    put(values_[k], k - node.first);
    for (std::size_t p = column_offsets_[k]; p < column_offsets_[k + 1]; ++p) put(values_[tree_.order.size() + p], front_rows_[p]);
  }
}

/// What is left of a child to its parent's front.
template <int D>
void BlockCholesky<D>::add_rest(std::size_t child, const DenseFront& dense) const {
  const Supernode& node = tree_.nodes[child];
  const Index* to = tree_.parent_rows.data() + node.rows;
  const std::size_t count = node.below(), stride = count * kD;
  const double* rest = rests_.data() + places_[child].rest;
  for (std::size_t j = 0; j < count; ++j)
    for (std::size_t c = 0; c < kD; ++c, rest += stride) {
      double* column = dense.column(to[j] * kD + c);
      for (std::size_t r = c; r < kD; ++r) column[to[j] * kD + r] += rest[j * kD + r];
      for (std::size_t i = j + 1; i < count; ++i)
        for (std::size_t r = 0; r < kD; ++r) column[to[i] * kD + r] += rest[i * kD + r];
    }
}

template <int D>
void BlockCholesky<D>::solve(std::span<double> b) const {
  solve_all<1>({b.data()});
}

template <int D>
void BlockCholesky<D>::solve(std::span<double> b, std::span<double> c) const {
  solve_all<2>({b.data(), c.data()});
}

template <int D>
template <std::size_t Q>
void BlockCholesky<D>::solve_all(const std::array<double*, Q>& b) const {
  const std::size_t n = tree_.order.size();
  std::array<std::vector<double>, Q> y;
  for (std::size_t q = 0; q < Q; ++q) {
    y[q].resize(n * kD);
    for (std::size_t i = 0; i < n; ++i) std::copy_n(b[q] + tree_.order[i] * kD, kD, y[q].data() + i * kD);
  }
  for (std::size_t s = 0; s < tree_.nodes.size(); ++s) solve_front<Q>(s, y, false);
  for (std::size_t s = tree_.nodes.size(); s-- > 0;) solve_front<Q>(s, y, true);
  for (std::size_t q = 0; q < Q; ++q)
    for (std::size_t i = 0; i < n; ++i) std::copy_n(y[q].data() + i * kD, kD, b[q] + tree_.order[i] * kD);
}

template <int D>
template <std::size_t Q>
void BlockCholesky<D>::solve_front(std::size_t s, std::array<std::vector<double>, Q>& y, bool upper) const {
  const Supernode& node = tree_.nodes[s];
  const std::size_t height = node.height() * kD, width = node.width() * kD;
  gathered_.resize(std::max(gathered_.size(), Q * height));
  std::array<double*, Q> x;
  for (std::size_t q = 0; q < Q; ++q) {
    x[q] = gathered_.data() + q * height;
    std::copy_n(y[q].data() + node.first * kD, width, x[q]);
    for (std::size_t i = 0; i < node.below(); ++i)
      for (std::size_t r = 0; r < kD; ++r) x[q][width + i * kD + r] = y[q][tree_.rows[node.rows + i] * kD + r];
  }
  const FactorColumns columns{factor_.data() + places_[s].pivots, height, width};
  if (upper)
    solve_upper<Q>(columns, x);
  else
    solve_lower<Q>(columns, x);
  for (std::size_t q = 0; q < Q; ++q) {
    std::copy_n(x[q], width, y[q].data() + node.first * kD);
    if (upper) continue;
    for (std::size_t i = 0; i < node.below(); ++i)
      for (std::size_t r = 0; r < kD; ++r) y[q][tree_.rows[node.rows + i] * kD + r] = x[q][width + i * kD + r];
  }
}

template class BlockCholesky<2>;
template class BlockCholesky<3>;

}  // namespace dmoscope
