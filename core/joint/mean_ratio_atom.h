#pragma once
// Mean ratio of an atom with its derivatives in closed form: it depends on the atom's edges against the ideal ones, T, by its determinant J
// and its norm alone.

#include <array>
#include <cmath>
#include <limits>

#include "core/joint/atoms.h"
#include "core/numeric/scalar.h"

namespace dmoscope {

/// Weights that give T: its column c is the sum over the edges j of weight[j][c] * edge j.
template <int D>
using IdealWeights = std::array<std::array<double, D>, D>;

template <int D>
[[nodiscard]] inline IdealWeights<D> ideal_weights(AtomShape shape) {
  constexpr double kRoot3 = 1.7320508075688772, kRoot2 = 1.4142135623730951;
  if constexpr (D == 2) {
    if (shape == AtomShape::Triangle) return {{{1.0, -1.0 / kRoot3}, {0.0, 2.0 / kRoot3}}};
    return {{{1.0, 0.0}, {0.0, 1.0}}};
  } else {
    switch (shape) {
      case AtomShape::Tetrahedron:
        return {{{1.0, -1.0 / kRoot3, -1.0 / (kRoot2 * kRoot3)},
                 {0.0, 2.0 / kRoot3, -1.0 / (kRoot2 * kRoot3)},
                 {0.0, 0.0, 3.0 / (kRoot2 * kRoot3)}}};
      case AtomShape::PrismCorner:
        return {{{1.0, -1.0 / kRoot3, 0.0}, {0.0, 2.0 / kRoot3, 0.0}, {0.0, 0.0, 1.0}}};
      case AtomShape::PyramidCorner:
        return {{{1.0, 0.0, -1.0 / kRoot2}, {0.0, 1.0, -1.0 / kRoot2}, {0.0, 0.0, kRoot2}}};
      default:
        return {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
    }
  }
}

/// Matrix with its determinant, the derivative of that by it, and the square of its norm.
template <int D>
struct MatrixOfColumns {
  static constexpr std::size_t kD = D, kCount = kD * kD;
  using Column = std::array<double, kD>;

  MatrixOfColumns() = default;
  explicit MatrixOfColumns(const std::array<Column, kD>& columns) : column(columns) { measure(); }
  /// Computes determinant, cofactors and norm of the present columns.
  void measure() {
    if constexpr (D == 2) {
      cofactor = {{{column[1][1], -column[1][0]}, {-column[0][1], column[0][0]}}};
    } else {
      cofactor = {cross(column[1], column[2]), cross(column[2], column[0]), cross(column[0], column[1])};
    }
    determinant = square = 0.0;
    for (std::size_t r = 0; r < kD; ++r) determinant += column[0][r] * cofactor[0][r];
    for (const Column& c : column)
      for (const double x : c) square += x * x;
  }

  std::array<Column, kD> column{}, cofactor{};
  double determinant = 0.0, square = 0.0;

 private:
  static Column cross(const Column& a, const Column& b) {
    if constexpr (D == 3)
      return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    else
      return {};
  }
};

/// Matrix T of an atom.
template <int D>
class MatrixAgainstIdeal : public MatrixOfColumns<D> {
 public:
  using Base = MatrixOfColumns<D>;
  using Base::kCount, Base::kD, Base::column;
  using typename Base::Column;

  MatrixAgainstIdeal(AtomShape shape, const AtomEdges<D>& edges) : weights_(ideal_weights<D>(shape)) {
    for (std::size_t c = 0; c < kD; ++c)
      for (std::size_t j = 0; j < kD; ++j)
        for (std::size_t r = 0; r < kD; ++r) column[c][r] += weights_[j][c] * edges[j][r];
    this->measure();
  }

  /// Adds w times the second derivatives of the determinant by T to a matrix of T's entries, column by column.
  void add_bend(double w, std::array<double, kCount * kCount>& h) const {
    const auto at = [&h](std::size_t i, std::size_t j) -> double& { return h[i * kCount + j]; };
    if constexpr (D == 2) {
      at(0, 3) += w, at(3, 0) += w;
      at(1, 2) -= w, at(2, 1) -= w;
    } else {
      for (std::size_t i = 0; i < 3; ++i) {  // J = t_i . (t_j x t_k)
        const std::size_t j = (i + 1) % 3;
        const Column& k = column[(i + 2) % 3];
        const auto add = [&](std::size_t r, std::size_t s, double x) {
          at(3 * i + r, 3 * j + s) += w * x;
          at(3 * j + s, 3 * i + r) += w * x;
        };
        add(0, 1, k[2]), add(0, 2, -k[1]), add(1, 2, k[0]);
        add(1, 0, -k[2]), add(2, 0, k[1]), add(2, 1, -k[0]);
      }
    }
  }

  /// Turns derivatives by T into those by the edges.
  void to_edges(const std::array<double, kCount>& g, const std::array<double, kCount * kCount>& h, AtomDerivatives<D>& result) const {
    std::array<double, kCount * kCount> half{};  // rows by T, columns by the edges
    result.gradient = {};
    result.hessian = {};
    for (std::size_t j = 0; j < kD; ++j)
      for (std::size_t c = 0; c < kD; ++c) {
        const double w = weights_[j][c];
        if (w == 0.0) continue;
        for (std::size_t r = 0; r < kD; ++r) result.gradient[j * kD + r] += w * g[c * kD + r];
        for (std::size_t i = 0; i < kCount; ++i)
          for (std::size_t r = 0; r < kD; ++r) half[i * kCount + j * kD + r] += w * h[i * kCount + c * kD + r];
      }
    for (std::size_t j = 0; j < kD; ++j)
      for (std::size_t c = 0; c < kD; ++c) {
        const double w = weights_[j][c];
        if (w == 0.0) continue;
        for (std::size_t r = 0; r < kD; ++r)
          for (std::size_t i = 0; i < kCount; ++i) result.hessian[(j * kD + r) * kCount + i] += w * half[(c * kD + r) * kCount + i];
      }
  }

 private:
  IdealWeights<D> weights_;
};

/// J^(2 / D), J > 0.
template <int D>
[[nodiscard]] inline double scale_of(double jacobian) {
  if constexpr (D == 2) return jacobian;
  const double root = scalar::cube_root(jacobian);
  return root * root;
}

/// Inverse of the mean ratio, |T|^2 / (D J^(2/D)).
template <int D>
[[nodiscard]] inline double inverse_mean_ratio(AtomShape shape, const AtomEdges<D>& edges, double /*reference*/) {
  const MatrixAgainstIdeal<D> t(shape, edges);
  const double scale = t.determinant > 0.0 ? scale_of<D>(t.determinant) : 0.0;
  return scale > 0.0 ? t.square / (D * scale) : std::numeric_limits<double>::infinity();
}

/// k / |T|^D, with k such that it is 1 for the ideal element: times J it is (mean ratio)^(D / 2), signed.
template <int D>
[[nodiscard]] inline double inverse_norm_power(double square) {
  if constexpr (D == 2) return 2.0 / square;
  return 5.196152422706632 / (square * std::sqrt(square));
}
/// Entries of a matrix in one row, column by column of the matrix.
template <int D>
[[nodiscard]] inline std::array<double, MatrixAgainstIdeal<D>::kCount> flat(
    const std::array<typename MatrixAgainstIdeal<D>::Column, MatrixAgainstIdeal<D>::kD>& columns, double factor) {
  std::array<double, MatrixAgainstIdeal<D>::kCount> row{};
  for (std::size_t c = 0, i = 0; c < columns.size(); ++c)
    for (const double x : columns[c]) row[i++] = factor * x;
  return row;
}

template <int D>
void derive_inverse_mean_ratio(AtomShape shape, const AtomEdges<D>& edges, double /*reference*/, Curvature curvature,
                               AtomDerivatives<D>& result) {
  constexpr std::size_t kCount = MatrixAgainstIdeal<D>::kCount;
  const MatrixAgainstIdeal<D> matrix(shape, edges);
  const double power = 2.0 / D, s = 1.0 / (D * scale_of<D>(matrix.determinant)), square = matrix.square;
  const auto t = flat<D>(matrix.column, 1.0), c = flat<D>(matrix.cofactor, 1.0 / matrix.determinant);
  std::array<double, kCount> g{};
  std::array<double, kCount * kCount> h{};
  const double both = -2.0 * power * s, twice = power * (power + 1.0) * square * s;
  for (std::size_t i = 0; i < kCount; ++i) {
    g[i] = s * (2.0 * t[i] - power * square * c[i]);
    for (std::size_t j = 0; j < kCount; ++j) h[i * kCount + j] = both * (t[i] * c[j] + c[i] * t[j]) + twice * (c[i] * c[j]);
    h[i * kCount + i] += 2.0 * s;
  }
  if (curvature == Curvature::Exact) matrix.add_bend(-s * power * square / matrix.determinant, h);
  result.value = s * square;
  matrix.to_edges(g, h, result);
}

}  // namespace dmoscope
