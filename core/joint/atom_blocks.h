#pragma once
// Newton system of a joint problem: sums the atoms' gradients and Hessians by their free vertices, and solves for a step.

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "core/joint/block_cholesky.h"
#include "core/joint/interior_point.h"

namespace dmoscope {

/// Adjacency of the free vertices: neighbours share an atom.
template <int D>
[[nodiscard]] Adjacency atom_adjacency(const JointProblem<D>& problem) {
  std::vector<std::vector<Index>> neighbours(problem.free_vertices);
  for (const Atom<D>& atom : problem.atoms)
    for (const Index v : atom.vertices)
      for (const Index w : atom.vertices)
        if (v != w && v < problem.free_vertices && w < problem.free_vertices) neighbours[v].push_back(w);
  return adjacency_of(std::move(neighbours));
}

/// Spreads derivatives by an atom's edges over its vertices: vertex k >= 1 has those of edge k - 1, the first vertex the negative sum. The
/// problem must outlive it.
template <int D>
class AtomBlocks {
 public:
  static constexpr std::size_t kD = D, kVertices = kD + 1, kEdges = kD * kD;
  using Gradient = std::array<double, kEdges>;
  using Hessian = std::array<double, kEdges * kEdges>;  // row by row
  using ByVertex = std::array<double, kVertices>;

  /// `pool`: see BlockCholesky.
  explicit AtomBlocks(const JointProblem<D>& problem, ThreadPool* pool = nullptr)
      : cholesky(atom_adjacency(problem), std::span(problem.places).first(problem.free_vertices), pool),
        problem_(problem),
        slots_(problem.atoms.size()) {
    for (std::size_t a = 0; a < slots_.size(); ++a)
      for (std::size_t k = 0; k < kVertices; ++k)
        for (std::size_t l = 0; l <= k; ++l)
          if (is_free(a, k) && is_free(a, l))
            slots_[a][k * (k + 1) / 2 + l] = cholesky.slot(problem.atoms[a].vertices[k], problem.atoms[a].vertices[l]);
  }

  [[nodiscard]] bool is_free(std::size_t atom, std::size_t k) const { return problem_.atoms[atom].vertices[k] < problem_.free_vertices; }

  /// Adds an atom's Hessian to the matrix, and `shift` to the diagonal of its vertices.
  void add_hessian(std::size_t atom, const Hessian& h, const ByVertex& shift) {
    std::array<double, kD * kEdges> first_row{};  // rows of the first vertex, columns by the edges
    for (std::size_t i = 0; i < kD; ++i)
      for (std::size_t n = 0; n < kD * kEdges; ++n) first_row[n] -= h[i * kD * kEdges + n];
    for (std::size_t k = 0; k < kVertices; ++k) {
      if (!is_free(atom, k)) continue;
      const double* row = k == 0 ? first_row.data() : &h[(k - 1) * kD * kEdges];
      for (std::size_t l = 0; l <= k; ++l) {
        if (!is_free(atom, l)) continue;
        typename BlockCholesky<D>::Block block{};
        for (std::size_t r = 0; r < kD; ++r)
          for (std::size_t c = 0; c < kD; ++c) {
            if (l > 0) {
              block[r * kD + c] = row[r * kEdges + (l - 1) * kD + c];
              continue;
            }
            for (std::size_t j = 0; j < kD; ++j) block[r * kD + c] -= row[r * kEdges + j * kD + c];
          }
        if (k == l)
          for (std::size_t r = 0; r < kD; ++r) block[r * kD + r] += shift[k];
        if (problem_.path != nullptr) project(problem_.atoms[atom].vertices[k], problem_.atoms[atom].vertices[l], block);
        cholesky.add(slots_[atom][k * (k + 1) / 2 + l], block);
      }
    }
  }

  /// Adds factor * an atom's gradient to a vector of D numbers a free vertex.
  void add_gradient(std::size_t atom, double factor, const Gradient& g, std::vector<double>& sum) const {
    std::array<double, kD> of_first{};
    for (std::size_t i = 0; i < kEdges; ++i) of_first[i % kD] -= g[i];
    for (std::size_t k = 0; k < kVertices; ++k) {
      if (!is_free(atom, k)) continue;
      const double* gradient = k == 0 ? of_first.data() : &g[(k - 1) * kD];
      for (std::size_t r = 0; r < kD; ++r) sum[problem_.atoms[atom].vertices[k] * kD + r] += factor * gradient[r];
    }
  }

  /// Projects a vector of D numbers a free vertex onto the directions in which these may go.
  void project(std::vector<double>& vector) const {
    if (problem_.path == nullptr) return;
    const auto ways = problem_.path->ways();
    const auto bound = problem_.path->bound();
    for (std::size_t v = 0; v < ways.size(); ++v) {
      if (bound[v] == 0) continue;
      std::array<double, kD> along{};
      for (std::size_t i = 0; i < kD * kD; ++i) along[i / kD] += ways[v][i] * vector[v * kD + i % kD];
      std::copy(along.begin(), along.end(), vector.begin() + static_cast<std::ptrdiff_t>(v * kD));
    }
  }

  /// Makes vertices stiff in the directions in which they may not go. Nothing leads there: all else is projected.
  void hold() {
    if (problem_.path == nullptr) return;
    const auto ways = problem_.path->ways();
    const auto bound = problem_.path->bound();
    for (Index v = 0; v < problem_.free_vertices; ++v) {
      if (bound[v] == 0) continue;
      auto& block = cholesky.diagonal(v);
      double stiff = 0.0;
      for (std::size_t r = 0; r < kD; ++r) stiff += block[r * kD + r];
      if (!(stiff > 0.0)) stiff = 1.0;
      for (std::size_t i = 0; i < kD * kD; ++i) block[i] += stiff * ((i % (kD + 1) == 0 ? 1.0 : 0.0) - ways[v][i]);
    }
  }

  /// Scales the matrix's diagonal, to make up for rounding.
  void scale_diagonal(double factor) {
    for (Index v = 0; v < problem_.free_vertices; ++v) {
      auto& block = cholesky.diagonal(v);
      for (std::size_t r = 0; r < kD; ++r) block[r * kD + r] *= factor;
    }
  }

  BlockCholesky<D> cholesky;

 private:
  /// Projects a block between two free vertices onto the directions in which these may go.
  void project(Index row, Index column, typename BlockCholesky<D>::Block& block) const {
    const auto ways = problem_.path->ways();
    const auto bound = problem_.path->bound();
    const auto times = [](const auto& a, const auto& b) {
      typename BlockCholesky<D>::Block product{};
      for (std::size_t r = 0; r < kD; ++r)
        for (std::size_t i = 0; i < kD; ++i)
          for (std::size_t c = 0; c < kD; ++c) product[r * kD + c] += a[r * kD + i] * b[i * kD + c];
      return product;
    };
    if (bound[row] != 0) block = times(ways[row], block);
    if (bound[column] != 0) block = times(block, ways[column]);
  }

  /// Slots of the blocks between an atom's free vertices k >= l, at k (k + 1) / 2 + l.
  using Slots = std::array<typename BlockCholesky<D>::Slot, kVertices*(kVertices + 1) / 2>;
  const JointProblem<D>& problem_;
  std::vector<Slots> slots_;
};

}  // namespace dmoscope
