#include "core/joint/dense_front.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace dmoscope {

// The following is compiled for each SIMD level, by being inlined into a function for it. Vectors hold rows, so that how many fit into one
// changes no entry's sum: the terms of an entry are summed by columns of a chunk, ascending, and the sum is subtracted at once.
#define DMOSCOPE_INLINE [[gnu::always_inline]] inline

namespace {

constexpr std::size_t kTile = 16;     // rows that are updated together
constexpr std::size_t kBlock = 8;     // columns that are updated together; divides kTile
constexpr std::size_t kChunk = 256;   // columns whose products are subtracted at once: they stay in the cache
constexpr std::size_t kRowTiles = 8;  // tiles that meet all blocks of columns before the next ones do: they stay in the cache, too

/// Lanes of a vector, and the numbers of vectors of rows and of columns whose sums the registers hold.
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
  std::size_t first, count;  // range of columns
  [[nodiscard]] double* at(std::size_t row, std::size_t column) const {
    return data + ((row / kTile) * count + column - first) * kTile + row % kTile;
  }
};

std::size_t tiles_of(const DenseFront& front) { return (front.height + kTile - 1) / kTile; }

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

/// Updates a tile of rows and a block of columns.
template <class S>
DMOSCOPE_INLINE void update_tile(const double* a, const double* b, std::size_t count, double* const* columns) {
  constexpr std::size_t kRows = S::kLanes * S::kVectors;
  for (std::size_t c = 0; c < kBlock; c += S::kColumns)
    for (std::size_t r = 0; r < kTile; r += kRows) subtract_product<S>(a + r, b + c, count, columns + c, r);
}

/// Copy of a tile's entries that the front has, with room for all.
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

/// Subtracts the products of the packed columns before a block from its columns in [first, end), in the rows of a tile.
template <class S>
DMOSCOPE_INLINE void update_block(const DenseFront& front, const Packed& packed, std::size_t count, std::size_t tile, std::size_t block,
                                  std::size_t first, std::size_t end) {
  const std::size_t row = tile * kTile, column = block * kBlock;
  const double *a = packed.at(row, packed.first), *b = packed.at(column, packed.first);
  const bool has_rows = (row >= front.width || column + kBlock <= front.width) && row + kTile <= front.height;  // above the diagonal, too
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

/// Cholesky factor of a small block on the diagonal, and the inverses of its pivots.
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

/// Solves for a tile's rows below the corner, in its columns, and packs them.
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

/// Columns [first, first + n) of one block, from which the packed ones before are to be subtracted.
struct Panel {
  const DenseFront& front;
  const Packed& packed;
  std::size_t first, n;
  Corner& corner;
};

/// Factorises the block's corner, on the diagonal. False where a pivot is not positive.
template <class S>
DMOSCOPE_INLINE bool begin_panel(const Panel& panel) {
  const auto& [front, packed, first, n, corner] = panel;
  if (first > packed.first) update_block<S>(front, packed, first - packed.first, first / kTile, first / kBlock, first, first + n);
  return factorise_corner(front, first, n, corner);
}

/// Finishes the block's rows in a tile, below the corner and not above its tile.
template <class S>
DMOSCOPE_INLINE void finish_tile(const Panel& panel, std::size_t tile) {
  const auto& [front, packed, first, n, corner] = panel;
  const std::size_t below = first + n, row = tile * kTile, from = std::max(row, below), to = std::min(row + kTile, front.height);
  if (first > packed.first && tile > first / kTile)
    update_block<S>(front, packed, first - packed.first, tile, first / kBlock, first, first + n);
  if (from == row && to == row + kTile) {
    double* columns[kBlock];
    for (std::size_t c = 0; c < n; ++c) columns[c] = front.column(first + c) + row;
    solve_tile<S>(corner, n, columns, packed.at(row, first));
    return;
  }
  Copy<S> copy;
  for (std::size_t c = 0; c < n; ++c)
    for (std::size_t r = from; r < to; ++r) copy.entries[c][r - row] = front.column(first + c)[r];
  solve_tile<S>(corner, n, copy.columns, packed.at(row, first));
  for (std::size_t c = 0; c < n; ++c) {
    for (std::size_t r = from; r < to; ++r) front.column(first + c)[r] = copy.entries[c][r - row];
    for (std::size_t r = std::max(row, first + c); r < std::min(below, row + kTile); ++r) *packed.at(r, first + c) = corner.l[r - first][c];
  }
}

template <class S>
DMOSCOPE_INLINE void finish_panel(const Panel& panel, std::size_t from, std::size_t to) {
  // Takes copies, which nothing else writes to: the compiler keeps them in registers.
  const DenseFront front = panel.front;
  const Packed packed = panel.packed;
  Corner corner = panel.corner;
  const Panel own{front, packed, panel.first, panel.n, corner};
  for (std::size_t tile = from; tile < to; ++tile) finish_tile<S>(own, tile);
}

/// Subtracts the products of a chunk's columns from all columns behind it, in some tiles of rows.
template <class S>
DMOSCOPE_INLINE void update_behind(const DenseFront front, const Packed packed, std::size_t from, std::size_t to) {
  const std::size_t first = packed.first + packed.count;
  for (std::size_t block = first / kBlock; block * kBlock < std::min(to * kTile, front.height); ++block)
    for (std::size_t tile = std::max(from, block * kBlock / kTile); tile < to; ++tile)
      update_block<S>(front, packed, packed.count, tile, block, first, front.height);
}

/// Eliminates a front on one thread.
template <class S>
DMOSCOPE_INLINE bool eliminate_alone(const DenseFront& front, double* room) {
  const std::size_t tiles = tiles_of(front);
  for (std::size_t first = 0; first < front.width; first += kChunk) {
    const Packed packed{room, first, std::min(kChunk, front.width - first)};
    const std::size_t end = first + packed.count;
    for (std::size_t column = first; column < end; column += kBlock) {
      Corner corner;
      const Panel panel{front, packed, column, std::min(kBlock, end - column), corner};
      if (!begin_panel<S>(panel)) return false;
      for (std::size_t tile = column / kTile; tile < tiles; ++tile) finish_tile<S>(panel, tile);
    }
    for (std::size_t from = end / kTile; end < front.height && from < tiles; from += kRowTiles)
      update_behind<S>(front, packed, from, std::min(from + kRowTiles, tiles));
  }
  return true;
}

/// Functions that are compiled for a level. Lambdas would not be.
struct Level {
  bool (*eliminate_alone)(const DenseFront& front, double* room);
  bool (*begin_panel)(const Panel& panel);
  void (*finish_panel)(const Panel& panel, std::size_t from, std::size_t to);
  void (*update_behind)(const DenseFront& front, const Packed& packed, std::size_t from, std::size_t to);
};
constexpr Level kBaseline{[](const DenseFront& front, double* room) { return eliminate_alone<Baseline>(front, room); },
                          [](const Panel& panel) { return begin_panel<Baseline>(panel); },
                          [](const Panel& panel, std::size_t from, std::size_t to) { finish_panel<Baseline>(panel, from, to); },
                          [](const DenseFront& front, const Packed& packed, std::size_t from, std::size_t to) {
                            update_behind<Baseline>(front, packed, from, to);
                          }};

#if defined(__x86_64__)
#define DMOSCOPE_LEVEL(S, name, instructions)                                                                              \
  [[gnu::target(instructions)]] bool eliminate_alone_##name(const DenseFront& front, double* room) {                       \
    return eliminate_alone<S>(front, room);                                                                                \
  }                                                                                                                        \
  [[gnu::target(instructions)]] bool begin_panel_##name(const Panel& panel) { return begin_panel<S>(panel); }              \
  [[gnu::target(instructions)]] void finish_panel_##name(const Panel& panel, std::size_t from, std::size_t to) {           \
    finish_panel<S>(panel, from, to);                                                                                      \
  }                                                                                                                        \
  [[gnu::target(instructions)]] void update_behind_##name(const DenseFront& front, const Packed& packed, std::size_t from, \
                                                          std::size_t to) {                                                \
    update_behind<S>(front, packed, from, to);                                                                             \
  }                                                                                                                        \
  constexpr Level k##S{eliminate_alone_##name, begin_panel_##name, finish_panel_##name, update_behind_##name};
DMOSCOPE_LEVEL(Avx2, avx2, "avx2")
DMOSCOPE_LEVEL(Avx512, avx512, "avx512f,avx512dq,avx512vl")
#undef DMOSCOPE_LEVEL
#endif

const Level& level_of([[maybe_unused]] SimdLevel level) {
#if defined(__x86_64__)
  if (level == SimdLevel::Avx512) return kAvx512;
  if (level == SimdLevel::Avx2) return kAvx2;
#endif
  return kBaseline;
}

/// Number of multiplications below which threads would wait for each other longer than they work.
constexpr double kWorthThreads = 300'000.0;

/// Calls f(from, to) for all of `count` tiles; in parallel where there are enough multiplications.
template <class F>
void for_tiles(ThreadPool& pool, std::size_t count, std::size_t multiplications, const F& f) {
  if (static_cast<double>(multiplications) < kWorthThreads)
    f(0, count);
  else
    pool.parallel_for(count, kRowTiles, f);
}

}  // namespace

bool eliminate(const DenseFront& front, std::vector<double>& room, SimdLevel simd, ThreadPool* pool) {
  const Level& level = level_of(simd);
  const std::size_t tiles = tiles_of(front);
  room.resize(std::max(room.size(), tiles * kTile * std::min(front.width, kChunk)));
  if (pool == nullptr || static_cast<double>(front.height * front.height * front.width) < kWorthThreads)
    return level.eliminate_alone(front, room.data());
  for (std::size_t first = 0; first < front.width; first += kChunk) {
    const Packed packed{room.data(), first, std::min(kChunk, front.width - first)};
    const std::size_t end = first + packed.count;
    Corner corner;
    for (std::size_t column = first; column < end; column += kBlock) {
      const Panel panel{front, packed, column, std::min(kBlock, end - column), corner};
      if (!level.begin_panel(panel)) return false;
      const std::size_t top = column / kTile;
      for_tiles(*pool, tiles - top, (tiles - top) * kTile * kBlock * (column - first + kBlock),
                [&](std::size_t from, std::size_t to) { level.finish_panel(panel, top + from, top + to); });
    }
    if (end >= front.height) continue;
    const std::size_t top = end / kTile, rows = front.height - end;
    for_tiles(*pool, tiles - top, rows * rows * packed.count / 2, [&](std::size_t from, std::size_t to) {
      for (std::size_t tile = from; tile < to; tile += kRowTiles)
        level.update_behind(front, packed, top + tile, top + std::min(tile + kRowTiles, to));
    });
  }
  return true;
}

}  // namespace dmoscope
