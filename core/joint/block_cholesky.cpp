#include "core/joint/block_cholesky.h"

#include <algorithm>
#include <numeric>

namespace dmoscope {

template <int D>
BlockCholesky<D>::BlockCholesky(const Adjacency& graph, std::span<const std::array<double, D>> places, ThreadPool* pool, SimdLevel level)
    : level_(level), pool_(pool), tree_(find_supernodes(graph, nested_dissection<D>(graph, places))), place_(tree_.order.size()) {
  for (std::size_t k = 0; k < tree_.order.size(); ++k) place_[tree_.order[k]] = static_cast<Index>(k);
  index_columns(graph);
  find_branches();
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

/// Splits the heaviest subtree while it is too heavy for one thread among many. The result does not depend on the pool.
template <int D>
void BlockCholesky<D>::find_branches() {
  constexpr double kWorthThreads = 3e6;  // number of multiplications in all from which threads pay
  constexpr std::size_t kMostBranches = 32;
  constexpr double kHeavy = 1.0 / 16.0;  // share of all multiplications
  const std::size_t n = tree_.nodes.size();
  children_.resize(n);
  std::vector<double> work(n, 0.0);
  std::vector<std::size_t> first(n), size(n, 1);
  double all = 0.0;
  for (std::size_t s = 0; s < n; ++s) {
    const Supernode& node = tree_.nodes[s];
    const double height = static_cast<double>(node.height() * kD), below = static_cast<double>(node.below() * kD);
    const double own = (height * height * height - below * below * below) / 3.0;
    work[s] += own, all += own;
    first[s] = s + 1 - size[s];
    if (node.parent == kNoIndex) continue;
    children_[node.parent].push_back(static_cast<Index>(s));
    work[node.parent] += work[s], size[node.parent] += size[s];
  }
  std::vector<std::size_t> roots;
  if (all > kWorthThreads)
    for (std::size_t s = 0; s < n; ++s)
      if (tree_.nodes[s].parent == kNoIndex) roots.push_back(s);
  while (!roots.empty() && roots.size() < kMostBranches) {
    const auto heaviest = std::ranges::max_element(roots, {}, [&](std::size_t s) { return work[s]; });
    const std::size_t root = *heaviest;
    if (work[root] <= kHeavy * all || children_[root].empty()) break;
    roots.erase(heaviest);
    roots.insert(roots.end(), children_[root].begin(), children_[root].end());
  }
  std::ranges::sort(roots);
  std::size_t next = 0;
  for (const std::size_t root : roots) {
    branches_.push_back({first[root], root});
    for (; next < first[root]; ++next) trunk_.push_back(next);
    next = root + 1;
  }
  for (; next < n; ++next) trunk_.push_back(next);
}

/// Places the rests on two stacks, by whether their depth in the tree is even: when a front is begun its children's are on top of the one,
/// and its own goes to the other. For several threads each branch has two of its own, and the rest of its root stays until the trunk has
/// taken it.
template <int D>
void BlockCholesky<D>::place_fronts() {
  const std::size_t n = tree_.nodes.size();
  places_.resize(n);
  std::vector<std::size_t> depth(n, 0);
  for (std::size_t s = n; s-- > 0;)
    if (tree_.nodes[s].parent != kNoIndex) depth[s] = depth[tree_.nodes[s].parent] + 1;
  std::size_t pivots = 0, begin = 0;
  const auto size_of_rest = [&](std::size_t s) { return tree_.nodes[s].below() * tree_.nodes[s].below() * kD * kD; };
  for (std::size_t s = 0; s < n; ++s) {
    places_[s].pivots = pivots;
    pivots += tree_.nodes[s].height() * tree_.nodes[s].width() * kD * kD;
  }
  std::vector<bool> is_kept(n, false);  // marks the rests of branches' roots, which are on no stack of the trunk's
  const auto place = [&](std::span<const std::size_t> nodes) {
    std::array<std::size_t, 2> top{}, most{};
    for (const std::size_t s : nodes) {
      const std::size_t stack = depth[s] % 2;
      places_[s].rest = top[stack];
      top[stack] += size_of_rest(s);
      most[stack] = std::max(most[stack], top[stack]);
      const auto on_stack = std::ranges::find_if(children_[s], [&](Index child) { return !is_kept[child]; });
      if (on_stack != children_[s].end()) top[1 - stack] = places_[*on_stack].rest;
    }
    for (const std::size_t s : nodes) places_[s].rest += begin + (depth[s] % 2 == 1 ? most[0] : 0);
    begin += most[0] + most[1];
  };
  const auto place_all = [&](std::size_t first, std::size_t last) {
    std::vector<std::size_t> nodes(last + 1 - first);
    std::iota(nodes.begin(), nodes.end(), first);
    place(nodes);
  };
  if (is_alone() && n > 0) {
    place_all(0, n - 1);
  } else {
    for (const Branch& branch : branches_) {
      place_all(branch.first, branch.root);
      is_kept[branch.root] = true;
    }
    place(trunk_);
  }
  factor_.resize(pivots);
  rests_.resize(begin);
  rooms_.resize(branches_.size() + 1);
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
  if (is_alone()) {
    for (std::size_t s = 0; s < tree_.nodes.size(); ++s)
      if (!factorise_front(s, rooms_.back(), nullptr)) return false;
    return true;
  }
  std::vector<std::uint8_t> is_definite(branches_.size(), 1);
  for_chunks(pool_, branches_.size(), 1, [&](std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k)
      for (std::size_t s = branches_[k].first; s <= branches_[k].root && is_definite[k] != 0; ++s)
        is_definite[k] = factorise_front(s, rooms_[k], nullptr) ? 1 : 0;
  });
  if (std::ranges::count(is_definite, 0) > 0) return false;
  return std::ranges::all_of(trunk_, [this](std::size_t s) { return factorise_front(s, rooms_.back(), pool_); });
}

template <int D>
bool BlockCholesky<D>::factorise_front(std::size_t s, std::vector<double>& room, ThreadPool* pool) {
  const DenseFront dense = front(s);
  start_front(s, dense);
  for (const Index child : children_[s]) add_rest(child, dense);
  return eliminate(dense, room, level_, pool);
}

/// Fills a front with the matrix's columns.
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

/// Adds the rest of a child to its parent's front.
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
  Sides<Q> y;
  for (std::size_t q = 0; q < Q; ++q) {
    y[q].resize(n * kD);
    for (std::size_t i = 0; i < n; ++i) std::copy_n(b[q] + tree_.order[i] * kD, kD, y[q].data() + i * kD);
  }
  solve_lower_all<Q>(y);
  solve_upper_all<Q>(y);
  for (std::size_t q = 0; q < Q; ++q)
    for (std::size_t i = 0; i < n; ++i) std::copy_n(y[q].data() + i * kD, kD, b[q] + tree_.order[i] * kD);
}

template <int D>
template <std::size_t Q>
void BlockCholesky<D>::solve_lower_all(Sides<Q>& y) const {
  std::vector<Aside<Q>> asides(branches_.size());
  for_chunks(pool_, branches_.size(), 1, [&](std::size_t from, std::size_t to) {
    std::vector<double> room;
    for (std::size_t k = from; k < to; ++k) {
      const Supernode& root = tree_.nodes[branches_[k].root];
      asides[k].end = root.end;
      asides[k].rows = std::span(tree_.rows).subspan(root.rows, root.below());
      for (auto& sums : asides[k].sums) sums.assign(root.below() * kD, 0.0);
      for (std::size_t s = branches_[k].first; s <= branches_[k].root; ++s) solve_lower_front<Q>(s, y, room, &asides[k]);
    }
  });
  for (const Aside<Q>& aside : asides)
    for (std::size_t q = 0; q < Q; ++q)
      for (std::size_t i = 0; i < aside.rows.size(); ++i)
        for (std::size_t r = 0; r < kD; ++r) y[q][aside.rows[i] * kD + r] += aside.sums[q][i * kD + r];
  std::vector<double> room;
  for (const std::size_t s : trunk_) solve_lower_front<Q>(s, y, room, nullptr);
}

template <int D>
template <std::size_t Q>
void BlockCholesky<D>::solve_upper_all(Sides<Q>& y) const {
  std::vector<double> room_of_trunk;
  for (std::size_t i = trunk_.size(); i-- > 0;) solve_upper_front<Q>(trunk_[i], y, room_of_trunk);
  for_chunks(pool_, branches_.size(), 1, [&](std::size_t from, std::size_t to) {
    std::vector<double> room;
    for (std::size_t k = from; k < to; ++k)
      for (std::size_t s = branches_[k].root + 1; s-- > branches_[k].first;) solve_upper_front<Q>(s, y, room);
  });
}

template <int D>
FactorColumns BlockCholesky<D>::columns_of(std::size_t s) const {
  const Supernode& node = tree_.nodes[s];
  return {factor_.data() + places_[s].pivots, node.height() * kD, node.width() * kD};
}

/// Solves by the columns of a front. `aside`: that of the branch; null in the trunk.
template <int D>
template <std::size_t Q>
void BlockCholesky<D>::solve_lower_front(std::size_t s, Sides<Q>& y, std::vector<double>& room, Aside<Q>* aside) const {
  const Supernode& node = tree_.nodes[s];
  const FactorColumns columns = columns_of(s);
  room.resize(std::max(room.size(), Q * columns.height));
  std::array<double*, Q> x;
  // Calls f(entry of the front, entry of a right-hand side) for all below the columns.
  const auto for_rest = [&](std::size_t q, const auto& f) {
    std::size_t behind = 0;
    for (std::size_t i = 0; i < node.below(); ++i) {
      const Index row = tree_.rows[node.rows + i];
      double* to = y[q].data() + row * kD;
      if (aside != nullptr && row >= aside->end) {
        while (aside->rows[behind] != row) ++behind;
        to = aside->sums[q].data() + behind * kD;
      }
      for (std::size_t r = 0; r < kD; ++r) f(x[q][columns.width + i * kD + r], to[r]);
    }
  };
  for (std::size_t q = 0; q < Q; ++q) {
    x[q] = room.data() + q * columns.height;
    std::copy_n(y[q].data() + node.first * kD, columns.width, x[q]);
    for_rest(q, [](double& entry, const double& side) { entry = side; });
  }
  solve_lower<Q>(columns, x);
  for (std::size_t q = 0; q < Q; ++q) {
    std::copy_n(x[q], columns.width, y[q].data() + node.first * kD);
    for_rest(q, [](const double& entry, double& side) { side = entry; });
  }
}

template <int D>
template <std::size_t Q>
void BlockCholesky<D>::solve_upper_front(std::size_t s, Sides<Q>& y, std::vector<double>& room) const {
  const Supernode& node = tree_.nodes[s];
  const FactorColumns columns = columns_of(s);
  room.resize(std::max(room.size(), Q * columns.height));
  std::array<double*, Q> x;
  for (std::size_t q = 0; q < Q; ++q) {
    x[q] = room.data() + q * columns.height;
    std::copy_n(y[q].data() + node.first * kD, columns.width, x[q]);
    for (std::size_t i = 0; i < node.below(); ++i)
      std::copy_n(y[q].data() + tree_.rows[node.rows + i] * kD, kD, x[q] + columns.width + i * kD);
  }
  solve_upper<Q>(columns, x);
  for (std::size_t q = 0; q < Q; ++q) std::copy_n(x[q], columns.width, y[q].data() + node.first * kD);
}

template class BlockCholesky<2>;
template class BlockCholesky<3>;

}  // namespace dmoscope
