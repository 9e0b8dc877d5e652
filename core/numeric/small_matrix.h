#pragma once
// Matrices of 2 x 2 and 3 x 3, in double: those that a map of the plane or of space is, and symmetric ones, such as metric tensors.

#include <array>

namespace dmoscope {

/// Of dimension `n`, 2 or 3: at[row][column].
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
/// Of a matrix whose determinant is not 0.
[[nodiscard]] SmallMatrix inverse(const SmallMatrix& a);
/// How far it stretches one way more than another, by Frobenius norms: at least 1. Likewise.
[[nodiscard]] double condition(const SmallMatrix& a);

/// Of a symmetric matrix: values in no order, and vectors of length 1 as columns, by Jacobi's rotations.
struct Eigen {
  std::array<double, 3> values{};
  SmallMatrix vectors;
};
[[nodiscard]] Eigen eigen(const SmallMatrix& symmetric);
/// f of a symmetric matrix: the same vectors, f of the values.
[[nodiscard]] SmallMatrix apply(const SmallMatrix& symmetric, double (*f)(double));
/// L, upper triangular with positive diagonal, with L^T L the symmetric positive definite matrix (Cholesky).
[[nodiscard]] SmallMatrix upper_root(const SmallMatrix& positive);
/// a = stretch * rotation, the stretch symmetric and positive definite, of a matrix with positive determinant.
struct Polar {
  SmallMatrix stretch, rotation;
};
[[nodiscard]] Polar polar(const SmallMatrix& a);

}  // namespace dmoscope
