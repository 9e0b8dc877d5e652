#include "core/joint/dense_solve.h"

#include <cstring>

namespace dmoscope {

namespace {

/// Solves for N columns from `first` on.
template <std::size_t N, std::size_t Q>
void lower_columns(const FactorColumns& l, std::size_t first, const std::array<double*, Q>& x) {
  std::array<const double*, N> column;
  for (std::size_t c = 0; c < N; ++c) column[c] = l.entries + (first + c) * l.height;
  std::array<std::array<double, Q>, N> v;
  for (std::size_t c = 0; c < N; ++c)
    for (std::size_t q = 0; q < Q; ++q) {
      v[c][q] = x[q][first + c] / column[c][first + c];
      x[q][first + c] = v[c][q];
      for (std::size_t r = c + 1; r < N; ++r) x[q][first + r] -= column[c][first + r] * v[c][q];
    }
  for (std::size_t q = 0; q < Q; ++q) {
    double* __restrict to = x[q];
    for (std::size_t r = first + N; r < l.height; ++r) {
      double sum = to[r];
      for (std::size_t c = 0; c < N; ++c) sum -= column[c][r] * v[c][q];
      to[r] = sum;
    }
  }
}

template <std::size_t N, std::size_t Q>
void upper_columns(const FactorColumns& l, std::size_t first, const std::array<double*, Q>& x) {
  typedef double Pair __attribute__((vector_size(16)));  // rows two by two everywhere: part of the order of the sums
  std::array<const double*, N> column;
  for (std::size_t c = 0; c < N; ++c) column[c] = l.entries + (first + c) * l.height;
  Pair sum[N][Q] = {};
  std::size_t r = first + N;
  for (; r + 2 <= l.height; r += 2) {
    Pair known[Q], entries;
    for (std::size_t q = 0; q < Q; ++q) std::memcpy(&known[q], x[q] + r, sizeof(Pair));
    for (std::size_t c = 0; c < N; ++c) {
      std::memcpy(&entries, column[c] + r, sizeof entries);
      for (std::size_t q = 0; q < Q; ++q) sum[c][q] += entries * known[q];
    }
  }
  for (std::size_t c = N; c-- > 0;)
    for (std::size_t q = 0; q < Q; ++q) {
      double rest = x[q][first + c] - (sum[c][q][0] + sum[c][q][1]);
      if (r < l.height) rest -= column[c][r] * x[q][r];
      for (std::size_t e = c + 1; e < N; ++e) rest -= column[c][first + e] * x[q][first + e];
      x[q][first + c] = rest / column[c][first + c];
    }
}

}  // namespace

template <std::size_t Q>
void solve_lower(const FactorColumns& l, const std::array<double*, Q>& x) {
  std::size_t first = 0;
  for (; first + 4 <= l.width; first += 4) lower_columns<4, Q>(l, first, x);
  for (; first < l.width; ++first) lower_columns<1, Q>(l, first, x);
}

template <std::size_t Q>
void solve_upper(const FactorColumns& l, const std::array<double*, Q>& x) {
  std::size_t first = l.width;
  for (; first % 4 != 0; --first) upper_columns<1, Q>(l, first - 1, x);
  for (; first > 0; first -= 4) upper_columns<4, Q>(l, first - 4, x);
}

template void solve_lower<1>(const FactorColumns&, const std::array<double*, 1>&);
template void solve_lower<2>(const FactorColumns&, const std::array<double*, 2>&);
template void solve_upper<1>(const FactorColumns&, const std::array<double*, 1>&);
template void solve_upper<2>(const FactorColumns&, const std::array<double*, 2>&);

}  // namespace dmoscope
