#include "core/joint/element_blocks.h"

#include <algorithm>
#include <utility>

namespace dmoscope {

namespace {

/// Adjacency of the free vertices: neighbours share an element.
template <int D>
Adjacency element_adjacency(const FoldoverFreeProblem<D>& problem) {
  std::vector<std::vector<Index>> neighbours(problem.free_vertices);
  for (const auto& element : problem.elements) {
    const std::size_t corners = info(element.kind).corners;
    for (std::size_t k = 0; k < corners; ++k)
      for (std::size_t l = 0; l < corners; ++l) {
        const Index v = element.vertices[k], w = element.vertices[l];
        if (v != w && v < problem.free_vertices && w < problem.free_vertices) neighbours[v].push_back(w);
      }
  }
  return adjacency_of(std::move(neighbours));
}

template <std::size_t D>
std::array<double, D * D> transposed(const std::array<double, D * D>& block) {
  std::array<double, D * D> result{};
  for (std::size_t r = 0; r < D; ++r)
    for (std::size_t c = 0; c < D; ++c) result[c * D + r] = block[r * D + c];
  return result;
}

/// Product of two blocks.
template <std::size_t D>
std::array<double, D * D> times(const std::array<double, D * D>& a, const std::array<double, D * D>& b) {
  std::array<double, D * D> product{};
  for (std::size_t r = 0; r < D; ++r)
    for (std::size_t i = 0; i < D; ++i)
      for (std::size_t c = 0; c < D; ++c) product[r * D + c] += a[r * D + i] * b[i * D + c];
  return product;
}

constexpr double kOntoDiagonal = 1e-9;  // share of the diagonal that is added against rounding

template <int D>
auto matrix_for(const FoldoverFreeProblem<D>& problem, ThreadPool* pool) {
  if constexpr (D == 2)
    return BlockCholesky<D>(element_adjacency(problem), problem.places, pool);
  else
    return BlockConjugate<D>(element_adjacency(problem), pool);
}

}  // namespace

template <int D>
ElementBlocks<D>::ElementBlocks(const FoldoverFreeProblem<D>& problem, ThreadPool* pool)
    : problem_(problem), matrix_(matrix_for(problem, pool)) {
  for (const Element& element : problem.elements) {
    first_slot_.push_back(slots_.size());
    for (std::size_t k = 0; k < info(element.kind).corners; ++k)
      for (std::size_t l = 0; l <= k; ++l) {
        const Index v = element.vertices[k], w = element.vertices[l];
        if (v < problem.free_vertices && w < problem.free_vertices) slots_.push_back(matrix_.slot(v, w));
      }
  }
}

template <int D>
void ElementBlocks<D>::clear() {
  matrix_.clear();
  gradient_.assign(problem_.free_vertices * kD, 0.0);
}

template <int D>
void ElementBlocks<D>::add(std::size_t index, const Derivatives& derivatives) {
  const Element& element = problem_.elements[index];
  std::size_t slot = first_slot_[index];
  for (std::size_t k = 0; k < info(element.kind).corners; ++k) {
    const Index v = element.vertices[k];
    if (v >= problem_.free_vertices) continue;
    for (std::size_t r = 0; r < kD; ++r) gradient_[v * kD + r] += derivatives.gradient[k][r];
    for (std::size_t l = 0; l <= k; ++l) {
      const Index w = element.vertices[l];
      if (w >= problem_.free_vertices) continue;
      Block block = derivatives.hessian[k * (k + 1) / 2 + l];
      if (k != l && v == w) {  // an element with a vertex twice
        const Block other = transposed<kD>(block);
        for (std::size_t i = 0; i < block.size(); ++i) block[i] += other[i];
      }
      if (problem_.path != nullptr) project(v, w, block);
      matrix_.add(slots_[slot++], block);
    }
  }
}

template <int D>
bool ElementBlocks<D>::solve(double damping, std::vector<double>& step) {
  for (Index v = 0; v < problem_.free_vertices; ++v) {
    Block& block = matrix_.diagonal(v);
    for (std::size_t r = 0; r < kD; ++r) block[r * kD + r] *= 1.0 + kOntoDiagonal + damping;
  }
  hold();
  if (!matrix_.factorise()) return false;
  step = gradient_;
  for (double& x : step) x = -x;
  project(step);
  matrix_.solve(step);
  project(step);
  return true;
}

/// Projects a block between two free vertices onto the directions in which these may go.
template <int D>
void ElementBlocks<D>::project(Index row, Index column, Block& block) const {
  const auto ways = problem_.path->ways();
  if (is_bound(row)) block = times<kD>(ways[row], block);
  if (is_bound(column)) block = times<kD>(block, ways[column]);
}

template <int D>
void ElementBlocks<D>::project(std::vector<double>& vector) const {
  for (Index v = 0; problem_.path != nullptr && v < problem_.free_vertices; ++v) {
    if (!is_bound(v)) continue;
    std::array<double, kD> along{};
    for (std::size_t i = 0; i < kD * kD; ++i) along[i / kD] += problem_.path->ways()[v][i] * vector[v * kD + i % kD];
    std::copy(along.begin(), along.end(), vector.begin() + static_cast<std::ptrdiff_t>(v * kD));
  }
}

/// Makes vertices stiff in the directions in which they may not go. Nothing leads there: all else is projected.
template <int D>
void ElementBlocks<D>::hold() {
  for (Index v = 0; problem_.path != nullptr && v < problem_.free_vertices; ++v) {
    if (!is_bound(v)) continue;
    Block& block = matrix_.diagonal(v);
    double stiff = 0.0;
    for (std::size_t r = 0; r < kD; ++r) stiff += block[r * kD + r];
    if (!(stiff > 0.0)) stiff = 1.0;
    for (std::size_t i = 0; i < kD * kD; ++i) block[i] += stiff * ((i % (kD + 1) == 0 ? 1.0 : 0.0) - problem_.path->ways()[v][i]);
  }
}

template class ElementBlocks<2>;
template class ElementBlocks<3>;

}  // namespace dmoscope
