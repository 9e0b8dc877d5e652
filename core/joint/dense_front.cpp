#include "core/joint/dense_front.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace dmoscope {

// What follows is compiled for each SIMD level, by being inlined into a function for it. Vectors hold rows, so that how many fit into one
// changes no entry's sum: the terms of an entry are summed by columns of a chunk, ascending, and the sum is subtracted at once.
#define DMOSCOPE_INLINE [[gnu::always_inline]] inline

namespace {

constexpr std::size_t kTile = 16;     // rows that are updated together
constexpr std::size_t kBlock = 8;     // columns that are updated together; divides kTile
constexpr std::size_t kChunk = 256;   // columns whose products are subtracted at once: they stay in the cache
constexpr std::size_t kRowTiles = 8;  // which meet all blocks of columns before the next ones do, likewise

/// Lanes of a vector, and how many vectors of rows and how many columns the registers hold the sums of.
struct Baseline {
  typedef double Vector __attribute__((vector_size(16)));
  static constexpr std::size_t kLanes = 2, kVectors = 2, kColumns = 4;
};
struct Avx2 {
  typedef double Vector __attribute__((vector_size(32)));
  static constexpr std::size_t kLanes = 4, kVectors = 2, kColumns = 4;
};
struct Avx512 {
  typedef double Vector __attribute__((vector_size(64)));
  static constexpr std::size_t kLanes = 8, kVectors = 2, kColumns = 8;
};

/// Eliminated columns of a chunk, rows by tiles: for each tile column by column its 16 rows.
struct Packed {
  double* data;
  std::size_t first, count;  // columns
  [[nodiscard]] double* at(std::size_t row, std::size_t column) const {
    return data + ((row / kTile) * count + column - first) * kTile + row % kTile;
  }
};

template <class S>
DMOSCOPE_INLINE void load(typename S::Vector& v, const double* from) {
  std::memcpy(&v, from, sizeof v);
}
template <class S>
DMOSCOPE_INLINE void store(const typename S::Vector& v, double* to) {
  std::memcpy(to, &v, sizeof v);
}

/// Subtracts a * b^T from some rows of some columns: a and b have their rows beside each other, kTile apart from column to column.
template <class S>
DMOSCOPE_INLINE void subtract_product(const double* a, const double* b, std::size_t count, double* const* columns, std::size_t row) {
  typename S::Vector sum[S::kColumns][S::kVectors] = {};
  for (std::size_t k = 0; k < count; ++k, a += kTile, b += kTile) {
    typename S::Vector rows[S::kVectors];
#pragma GCC unroll 8
    for (std::size_t v = 0; v < S::kVectors; ++v) load<S>(rows[v], a + v * S::kLanes);
#pragma GCC unroll 8
    for (std::size_t c = 0; c < S::kColumns; ++c)
#pragma GCC unroll 8
      for (std::size_t v = 0; v < S::kVectors; ++v) sum[c][v] += rows[v] * b[c];
  }
#pragma GCC unroll 8
  for (std::size_t c = 0; c < S::kColumns; ++c)
#pragma GCC unroll 8
    for (std::size_t v = 0; v < S::kVectors; ++v) {
      typename S::Vector entry;
      load<S>(entry, columns[c] + row + v * S::kLanes);
      entry -= sum[c][v];
      store<S>(entry, columns[c] + row + v * S::kLanes);
    }
}

/// Of a tile of rows and a block of columns.
template <class S>
DMOSCOPE_INLINE void update_tile(const double* a, const double* b, std::size_t count, double* const* columns) {
  constexpr std::size_t kRows = S::kLanes * S::kVectors;
  for (std::size_t c = 0; c < kBlock; c += S::kColumns)
    for (std::size_t r = 0; r < kTile; r += kRows) subtract_product<S>(a + r, b + c, count, columns + c, r);
}

/// A tile's entries that the front has, copied to where there is room for all.
template <class S>
struct Copy {
  double entries[kBlock][kTile];
  double* columns[kBlock];
  DMOSCOPE_INLINE Copy() {
    const typename S::Vector zero{};
    for (std::size_t c = 0; c < kBlock; ++c) {
      columns[c] = entries[c];
      for (std::size_t r = 0; r < kTile; r += S::kLanes) store<S>(zero, entries[c] + r);
    }
  }
};

/// The columns of a block that are in [first, end), in the rows of a tile: the products of the packed columns before are subtracted.
template <class S>
DMOSCOPE_INLINE void update_block(const DenseFront& front, const Packed& packed, std::size_t count, std::size_t tile, std::size_t block,
                                  std::size_t first, std::size_t end) {
  const std::size_t row = tile * kTile, column = block * kBlock;
  const double *a = packed.at(row, packed.first), *b = packed.at(column, packed.first);
  const bool has_rows = (row >= front.width || column + kBlock <= front.width) && row + kTile <= front.height;  // if above the diagonal
  if (has_rows && column >= first && column + kBlock <= end) {
    double* columns[kBlock];
    for (std::size_t c = 0; c < kBlock; ++c) columns[c] = front.column(column + c) + row;
    update_tile<S>(a, b, count, columns);
    return;
  }
  Copy<S> copy;
  const std::size_t from = std::max(column, first), to = std::min(column + kBlock, end), last = std::min(row + kTile, front.height);
  for (std::size_t c = from; c < to; ++c)
    for (std::size_t r = std::max(row, c); r < last; ++r) copy.entries[c - column][r - row] = front.column(c)[r];
  update_tile<S>(a, b, count, copy.columns);
  for (std::size_t c = from; c < to; ++c)
    for (std::size_t r = std::max(row, c); r < last; ++r) front.column(c)[r] = copy.entries[c - column][r - row];
}

/// The Cholesky factor of a small block on the diagonal, and the inverses of its pivots.
struct Corner {
  double l[kBlock][kBlock];
  double inverse[kBlock];
};
DMOSCOPE_INLINE bool factorise_corner(const DenseFront& front, std::size_t first, std::size_t n, Corner& corner) {
  for (std::size_t c = 0; c < n; ++c)
    for (std::size_t r = c; r < n; ++r) corner.l[r][c] = front.column(first + c)[first + r];
  for (std::size_t c = 0; c < n; ++c) {
    for (std::size_t e = 0; e < c; ++e)
      for (std::size_t r = c; r < n; ++r) corner.l[r][c] -= corner.l[r][e] * corner.l[c][e];
    const double pivot = corner.l[c][c];
    if (!(pivot > 0.0) || !std::isfinite(pivot)) return false;
    corner.l[c][c] = std::sqrt(pivot);
    corner.inverse[c] = 1.0 / corner.l[c][c];
    for (std::size_t r = c + 1; r < n; ++r) corner.l[r][c] *= corner.inverse[c];
  }
  for (std::size_t c = 0; c < n; ++c)
    for (std::size_t r = c; r < n; ++r) front.column(first + c)[first + r] = corner.l[r][c];
  return true;
}

/// A tile's rows below the corner, in its columns: each is solved for, and packed.
template <class S>
DMOSCOPE_INLINE void solve_tile(const Corner& corner, std::size_t n, double* const* columns, double* packed) {
  for (std::size_t r = 0; r < kTile; r += S::kLanes)
    for (std::size_t c = 0; c < n; ++c) {
      typename S::Vector x;
      load<S>(x, columns[c] + r);
      for (std::size_t e = 0; e < c; ++e) {
        typename S::Vector other;
        load<S>(other, packed + e * kTile + r);
        x -= other * corner.l[c][e];
      }
      x *= corner.inverse[c];
      store<S>(x, columns[c] + r);
      store<S>(x, packed + c * kTile + r);
    }
}

/// Columns [first, first + n) of one block, from the diagonal down.
template <class S>
DMOSCOPE_INLINE bool eliminate_block(const DenseFront& front, const Packed& packed, std::size_t first, std::size_t n) {
  Corner corner;
  if (!factorise_corner(front, first, n, corner)) return false;
  const std::size_t below = first + n;
  for (std::size_t tile = first / kTile; tile * kTile < front.height; ++tile) {
    const std::size_t row = tile * kTile, from = std::max(row, below), to = std::min(row + kTile, front.height);
    if (from == row && to == row + kTile) {
      double* columns[kBlock];
      for (std::size_t c = 0; c < n; ++c) columns[c] = front.column(first + c) + row;
      solve_tile<S>(corner, n, columns, packed.at(row, first));
      continue;
    }
    Copy<S> copy;
    for (std::size_t c = 0; c < n; ++c)
      for (std::size_t r = from; r < to; ++r) copy.entries[c][r - row] = front.column(first + c)[r];
    solve_tile<S>(corner, n, copy.columns, packed.at(row, first));
    for (std::size_t c = 0; c < n; ++c) {
      for (std::size_t r = from; r < to; ++r) front.column(first + c)[r] = copy.entries[c][r - row];
      for (std::size_t r = std::max(row, first + c); r < std::min(below, row + kTile); ++r)
        *packed.at(r, first + c) = corner.l[r - first][c];
    }
  }
  return true;
}

/// Subtracts the products of a chunk's columns from all columns behind it.
template <class S>
DMOSCOPE_INLINE void update_behind(const DenseFront& front, const Packed& packed) {
  const std::size_t first = packed.first + packed.count, tiles = (front.height + kTile - 1) / kTile;
  for (std::size_t from = first / kTile; from < tiles; from += kRowTiles) {
    const std::size_t to = std::min(from + kRowTiles, tiles);
    for (std::size_t block = first / kBlock; block * kBlock < std::min(to * kTile, front.height); ++block)
      for (std::size_t tile = std::max(from, block * kBlock / kTile); tile < to; ++tile)
        update_block<S>(front, packed, packed.count, tile, block, first, front.height);
  }
}

template <class S>
DMOSCOPE_INLINE bool eliminate_for(const DenseFront& front, std::vector<double>& room) {
  const std::size_t tiles = (front.height + kTile - 1) / kTile;
  room.resize(std::max(room.size(), tiles * kTile * std::min(front.width, kChunk)));
  for (std::size_t first = 0; first < front.width; first += kChunk) {
    const Packed packed{room.data(), first, std::min(kChunk, front.width - first)};
    const std::size_t end = first + packed.count;
    for (std::size_t column = first; column < end; column += kBlock) {
      const std::size_t n = std::min(kBlock, end - column);
      if (column > first)
        for (std::size_t tile = column / kTile; tile < tiles; ++tile)
          update_block<S>(front, packed, column - first, tile, column / kBlock, column, column + n);
      if (!eliminate_block<S>(front, packed, column, n)) return false;
    }
    if (end < front.height) update_behind<S>(front, packed);
  }
  return true;
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] bool eliminate_avx2(const DenseFront& front, std::vector<double>& room) { return eliminate_for<Avx2>(front, room); }
[[gnu::target("avx512f,avx512dq,avx512vl")]] bool eliminate_avx512(const DenseFront& front, std::vector<double>& room) {
  return eliminate_for<Avx512>(front, room);
}
#endif

}  // namespace

bool eliminate(const DenseFront& front, std::vector<double>& room, SimdLevel level) {
#if defined(__x86_64__)
  if (level == SimdLevel::Avx512) return eliminate_avx512(front, room);
  if (level == SimdLevel::Avx2) return eliminate_avx2(front, room);
#endif
  return eliminate_for<Baseline>(front, room);
}

}  // namespace dmoscope
