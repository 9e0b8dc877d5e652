#pragma once
// Small matrices, 2 x 2 and 3 x 3, in double: linear maps of the plane or of space, and symmetric ones, such as metric tensors.

#include <array>

namespace dmoscope {

/// A square matrix of dimension `n`, 2 or 3: at[row][column].
struct SmallMatrix {
  int n = 2;
  std::array<std::array<double, 3>, 3> at{};
  [[nodiscard]] static SmallMatrix identity(int n);
  [[nodiscard]] static SmallMatrix diagonal(int n, const std::array<double, 3>& values);
  friend bool operator==(const SmallMatrix&, const SmallMatrix&) = default;
};
[[nodiscard]] SmallMatrix operator*(const SmallMatrix& a, const SmallMatrix& b);
[[nodiscard]] SmallMatrix operator+(const SmallMatrix& a, const SmallMatrix& b);
[[nodiscard]] SmallMatrix scaled(double factor, const SmallMatrix& a);
[[nodiscard]] SmallMatrix transposed(const SmallMatrix& a);
[[nodiscard]] double determinant(const SmallMatrix& a);
/// The inverse of a matrix whose determinant is not 0.
[[nodiscard]] SmallMatrix inverse(const SmallMatrix& a);
/// Condition number by Frobenius norms, divided by the dimension, of a matrix whose determinant is not 0: at least 1.
[[nodiscard]] double condition(const SmallMatrix& a);

/// Eigenvalues, in no order, and unit eigenvectors, as columns, of a symmetric matrix, by Jacobi's rotations.
struct Eigen {
  std::array<double, 3> values{};
  SmallMatrix vectors;
};
[[nodiscard]] Eigen eigen(const SmallMatrix& symmetric);
/// The function f of a symmetric matrix: the same eigenvectors, f of the eigenvalues.
[[nodiscard]] SmallMatrix apply(const SmallMatrix& symmetric, double (*f)(double));
/// The upper triangular L with positive diagonal for which L^T L is the symmetric positive definite matrix (Cholesky).
[[nodiscard]] SmallMatrix upper_root(const SmallMatrix& positive);
/// Polar decomposition a = stretch * rotation, with a symmetric positive definite stretch, of a matrix with positive determinant.
struct Polar {
  SmallMatrix stretch, rotation;
};
[[nodiscard]] Polar polar(const SmallMatrix& a);

}  // namespace dmoscope
