#include "core/joint/block_conjugate.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dmoscope {

namespace {

constexpr std::size_t kGrain = 256;  // number of vertices
constexpr int kMostIterations = 300;
constexpr double kEnough = 1e-4;  // share of the square of the right-hand side's norm

/// Inverts a symmetric positive definite block; returns false where it is not positive definite.
template <std::size_t D>
bool invert(const std::array<double, D * D>& a, std::array<double, D * D>& inverse) {
  std::array<double, D * D> l{};  // Cholesky factor, and then its inverse
  for (std::size_t r = 0; r < D; ++r)
    for (std::size_t c = 0; c <= r; ++c) {
      double sum = a[r * D + c];
      for (std::size_t i = 0; i < c; ++i) sum -= l[r * D + i] * l[c * D + i];
      if (r == c && !(sum > 0.0)) return false;
      l[r * D + c] = r == c ? std::sqrt(sum) : sum / l[c * D + c];
    }
  std::array<double, D * D> m{};
  for (std::size_t c = 0; c < D; ++c)
    for (std::size_t r = c; r < D; ++r) {
      double sum = r == c ? 1.0 : 0.0;
      for (std::size_t i = c; i < r; ++i) sum -= l[r * D + i] * m[i * D + c];
      m[r * D + c] = sum / l[r * D + r];
    }
  for (std::size_t r = 0; r < D; ++r)
    for (std::size_t c = 0; c < D; ++c) {
      double sum = 0.0;
      for (std::size_t i = std::max(r, c); i < D; ++i) sum += m[i * D + r] * m[i * D + c];
      inverse[r * D + c] = sum;
    }
  return true;
}

/// Adds the product of a block and a vertex's numbers to y.
template <std::size_t D>
void add_product(const std::array<double, D * D>& block, const double* x, double* y) {
  for (std::size_t r = 0; r < D; ++r)
    for (std::size_t c = 0; c < D; ++c) y[r] += block[r * D + c] * x[c];
}

double sum_of(const std::vector<double>& parts) {
  double sum = 0.0;
  for (const double part : parts) sum += part;
  return sum;
}

}  // namespace

template <int D>
BlockConjugate<D>::BlockConjugate(Adjacency graph, ThreadPool* pool) : graph_(std::move(graph)), pool_(pool) {
  const std::size_t vertices = graph_.offsets.size() - 1;
  diagonal_.resize(vertices);
  inverse_.resize(vertices);
  values_.resize(graph_.neighbours.size());
  mirror_.resize(graph_.neighbours.size());
  for (Index i = 0; i < vertices; ++i)
    for (Index at = graph_.offsets[i]; at < graph_.offsets[i + 1]; ++at) {
      const Index j = graph_.neighbours[at];
      const auto across = graph_.of(j);
      mirror_[at] = graph_.offsets[j] + static_cast<Index>(std::ranges::lower_bound(across, i) - across.begin());
    }
}

template <int D>
typename BlockConjugate<D>::Slot BlockConjugate<D>::slot(Index i, Index j) const {
  if (i == j) return {static_cast<Index>(values_.size()) + i, false};
  const Index row = std::max(i, j), column = std::min(i, j);
  const auto of = graph_.of(row);
  return {graph_.offsets[row] + static_cast<Index>(std::ranges::lower_bound(of, column) - of.begin()), i < j};
}

template <int D>
void BlockConjugate<D>::clear() {
  std::ranges::fill(diagonal_, Block{});
  std::ranges::fill(values_, Block{});
}

template <int D>
void BlockConjugate<D>::add(Slot slot, const Block& block) {
  Block& to = slot.block < values_.size() ? values_[slot.block] : diagonal_[slot.block - values_.size()];
  for (std::size_t r = 0; r < kD; ++r)
    for (std::size_t c = 0; c < kD; ++c) to[r * kD + c] += slot.transposed ? block[c * kD + r] : block[r * kD + c];
}

template <int D>
bool BlockConjugate<D>::factorise() {
  for (Index i = 0; i < diagonal_.size(); ++i) {
    if (!invert<kD>(diagonal_[i], inverse_[i])) return false;
    for (Index at = graph_.offsets[i]; at < graph_.offsets[i + 1] && graph_.neighbours[at] < i; ++at)
      for (std::size_t r = 0; r < kD; ++r)
        for (std::size_t c = 0; c < kD; ++c) values_[mirror_[at]][c * kD + r] = values_[at][r * kD + c];
  }
  return true;
}

/// Computes y = A x; returns x y.
template <int D>
double BlockConjugate<D>::times(const Vector& x, Vector& y) const {
  std::vector<double> parts((diagonal_.size() + kGrain - 1) / kGrain, 0.0);
  for_chunks(pool_, diagonal_.size(), kGrain, [&](std::size_t first, std::size_t last) {
    double& sum = parts[first / kGrain];
    for (std::size_t i = first; i < last; ++i) {
      std::array<double, kD> row{};
      add_product<kD>(diagonal_[i], &x[i * kD], row.data());
      for (Index at = graph_.offsets[i]; at < graph_.offsets[i + 1]; ++at)
        add_product<kD>(values_[at], &x[graph_.neighbours[at] * kD], row.data());
      for (std::size_t r = 0; r < kD; ++r) {
        y[i * kD + r] = row[r];
        sum += row[r] * x[i * kD + r];
      }
    }
  });
  return sum_of(parts);
}

template <int D>
void BlockConjugate<D>::solve(std::span<double> b) const {
  const std::size_t vertices = diagonal_.size();
  Vector x(b.size(), 0.0), rest(b.begin(), b.end()), z(b.size(), 0.0), along(b.size(), 0.0), product(b.size(), 0.0);
  std::vector<double> parts((vertices + kGrain - 1) / kGrain);
  /// Goes a step, and returns rest z, with z the product of the inverse diagonal and the rest.
  const auto go = [&](double step) {
    std::ranges::fill(parts, 0.0);
    for_chunks(pool_, vertices, kGrain, [&](std::size_t first, std::size_t last) {
      double& sum = parts[first / kGrain];
      for (std::size_t i = first; i < last; ++i) {
        std::array<double, kD> by_diagonal{};
        for (std::size_t r = i * kD; r < (i + 1) * kD; ++r) {
          x[r] += step * along[r];
          rest[r] -= step * product[r];
        }
        add_product<kD>(inverse_[i], &rest[i * kD], by_diagonal.data());
        for (std::size_t r = 0; r < kD; ++r) {
          z[i * kD + r] = by_diagonal[r];
          sum += by_diagonal[r] * rest[i * kD + r];
        }
      }
    });
    return sum_of(parts);
  };
  double left = go(0.0);
  const double enough = kEnough * left;
  double turn = 0.0;
  for (int iteration = 0; iteration < kMostIterations && left > enough; ++iteration) {
    for_chunks(pool_, b.size(), kD * kGrain, [&](std::size_t first, std::size_t last) {
      for (std::size_t r = first; r < last; ++r) along[r] = z[r] + turn * along[r];
    });
    const double bend = times(along, product);
    if (!(bend > 0.0)) break;
    const double before = left;
    left = go(left / bend);
    turn = left / before;
  }
  std::ranges::copy(x, b.begin());
}

template class BlockConjugate<2>;
template class BlockConjugate<3>;

}  // namespace dmoscope
