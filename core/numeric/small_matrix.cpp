#include "core/numeric/small_matrix.h"

#include <cmath>

namespace dmoscope {

namespace {
template <class F>
void for_entries(int n, const F& f) {
  for (std::size_t i = 0; static_cast<int>(i) < n; ++i)
    for (std::size_t j = 0; static_cast<int>(j) < n; ++j) f(i, j);
}
}  // namespace

SmallMatrix SmallMatrix::identity(int n) { return diagonal(n, {1.0, 1.0, 1.0}); }

SmallMatrix SmallMatrix::diagonal(int n, const std::array<double, 3>& values) {
  SmallMatrix m{n, {}};
  for (std::size_t i = 0; static_cast<int>(i) < n; ++i) m.at[i][i] = values[i];
  return m;
}

SmallMatrix operator*(const SmallMatrix& a, const SmallMatrix& b) {
  SmallMatrix c{a.n, {}};
  for_entries(a.n, [&](std::size_t i, std::size_t j) {
    for (std::size_t k = 0; static_cast<int>(k) < a.n; ++k) c.at[i][j] += a.at[i][k] * b.at[k][j];
  });
  return c;
}

SmallMatrix operator+(const SmallMatrix& a, const SmallMatrix& b) {
  SmallMatrix c = a;
  for_entries(a.n, [&](std::size_t i, std::size_t j) { c.at[i][j] += b.at[i][j]; });
  return c;
}

SmallMatrix scaled(double factor, const SmallMatrix& a) {
  SmallMatrix c = a;
  for_entries(a.n, [&](std::size_t i, std::size_t j) { c.at[i][j] *= factor; });
  return c;
}

SmallMatrix transposed(const SmallMatrix& a) {
  SmallMatrix c{a.n, {}};
  for_entries(a.n, [&](std::size_t i, std::size_t j) { c.at[i][j] = a.at[j][i]; });
  return c;
}

double determinant(const SmallMatrix& a) {
  const auto& m = a.at;
  if (a.n == 2) return m[0][0] * m[1][1] - m[0][1] * m[1][0];
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

SmallMatrix inverse(const SmallMatrix& a) {
  const double factor = 1.0 / determinant(a);
  const auto& m = a.at;
  SmallMatrix c{a.n, {}};
  if (a.n == 2) {
    c.at[0][0] = factor * m[1][1];
    c.at[0][1] = -factor * m[0][1];
    c.at[1][0] = -factor * m[1][0];
    c.at[1][1] = factor * m[0][0];
    return c;
  }
  for_entries(3, [&](std::size_t i, std::size_t j) {
    const std::size_t r = (j + 1) % 3, s = (j + 2) % 3, p = (i + 1) % 3, q = (i + 2) % 3;
    c.at[i][j] = factor * (m[r][p] * m[s][q] - m[r][q] * m[s][p]);
  });
  return c;
}

double condition(const SmallMatrix& a) {
  const auto squares = [](const SmallMatrix& m) {
    double sum = 0.0;
    for (const auto& row : m.at)
      for (const double number : row) sum += number * number;
    return sum;
  };
  return std::sqrt(squares(a) * squares(inverse(a))) / a.n;
}

Eigen eigen(const SmallMatrix& symmetric) {
  constexpr int kMostSweeps = 40;  // limit of sweeps: each squares the remaining off-diagonal part, so a few suffice
  SmallMatrix a = symmetric, v = SmallMatrix::identity(a.n);
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    bool rotated = false;
    for (std::size_t p = 0; static_cast<int>(p) + 1 < a.n; ++p)
      for (std::size_t q = p + 1; static_cast<int>(q) < a.n; ++q) {
        const double off = a.at[p][q];
        if (!(std::abs(off) > 1e-17 * (std::abs(a.at[p][p]) + std::abs(a.at[q][q])))) continue;
        rotated = true;
        const double theta = 0.5 * (a.at[q][q] - a.at[p][p]) / off;
        const double t = (theta >= 0.0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
        const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
        SmallMatrix turn = SmallMatrix::identity(a.n);
        turn.at[p][p] = turn.at[q][q] = c;
        turn.at[p][q] = s;
        turn.at[q][p] = -s;
        a = transposed(turn) * a * turn;
        a.at[p][q] = a.at[q][p] = 0.0;
        v = v * turn;
      }
    if (!rotated) break;
  }
  return {{a.at[0][0], a.at[1][1], a.at[2][2]}, v};
}

SmallMatrix apply(const SmallMatrix& symmetric, double (*f)(double)) {
  const Eigen e = eigen(symmetric);
  std::array<double, 3> values{};
  for (std::size_t i = 0; static_cast<int>(i) < symmetric.n; ++i) values[i] = f(e.values[i]);
  return e.vectors * SmallMatrix::diagonal(symmetric.n, values) * transposed(e.vectors);
}

SmallMatrix upper_root(const SmallMatrix& positive) {
  SmallMatrix u{positive.n, {}};
  for (std::size_t i = 0; static_cast<int>(i) < positive.n; ++i) {
    double rest = positive.at[i][i];
    for (std::size_t k = 0; k < i; ++k) rest -= u.at[k][i] * u.at[k][i];
    u.at[i][i] = std::sqrt(rest);
    for (std::size_t j = i + 1; static_cast<int>(j) < positive.n; ++j) {
      double entry = positive.at[i][j];
      for (std::size_t k = 0; k < i; ++k) entry -= u.at[k][i] * u.at[k][j];
      u.at[i][j] = entry / u.at[i][i];
    }
  }
  return u;
}

Polar polar(const SmallMatrix& a) {
  const SmallMatrix stretch = apply(a * transposed(a), [](double value) { return std::sqrt(value > 0.0 ? value : 0.0); });
  return {stretch, inverse(stretch) * a};
}

}  // namespace dmoscope
