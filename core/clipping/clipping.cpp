#include "core/clipping/clipping.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>
#include <numeric>

#include "core/base/memory.h"

namespace dmoscope {

namespace {

/// Divisor: if more than 1 / kFewChanges of the cells changed, all are examined.
constexpr std::size_t kFewChanges = 8;

}  // namespace

Clipping::Clipping(const ElementTable& elements, const FaceNeighbours& faces)
    : elements_(elements), faces_(faces), cells_(elements, faces), open_(large_vector<std::uint8_t>(elements.size())) {}

/// Bits of the cell's faces that are to be drawn.
std::uint8_t Clipping::open_faces(Index cell) const noexcept {
  const auto visible = cells_.visible();
  if (visible[cell] == 0) return 0;
  const auto across = faces_.of(cell);
  if (all_faces_) return static_cast<std::uint8_t>((1U << across.size()) - 1U);
  unsigned open = 0;
  for (std::size_t f = 0; f < across.size(); ++f) {
    if (across[f] == kNoIndex || visible[across[f]] == 0) open |= 1U << f;
  }
  return static_cast<std::uint8_t>(open);
}

void Clipping::open_all(ThreadPool* pool) {
  for_chunks(pool, open_.size(), CellChunk::kCells, [&](std::size_t first, std::size_t last) {
    for (std::size_t e = first; e < last; ++e) open_[e] = open_faces(static_cast<Index>(e));
  });
}

/// Updates the cells that changed and their neighbours; no others can have other faces. Two threads may find the same for one neighbour.
void Clipping::open_changed(ThreadPool* pool) {
  const auto refresh = [&](Index e) { std::atomic_ref(open_[e]).store(open_faces(e), std::memory_order_relaxed); };
  for_chunks(pool, cells_.chunks().size(), 1, [&](std::size_t first, std::size_t last) {
    for (const CellChunk& chunk : cells_.chunks().subspan(first, last - first)) {
      for (const Index e : chunk.changed) {
        refresh(e);
        for (const Index other : faces_.of(e)) {
          if (other != kNoIndex) refresh(other);
        }
      }
    }
  });
}

/// Lists the faces of the bits: counts, then writes.
void Clipping::gather(ThreadPool* pool) {
  const std::size_t chunks = cells_.chunks().size();
  // Tests eight cells at once: most have no face to draw.
  const auto eight = [&](std::size_t e, std::size_t last) {
    std::uint64_t word = 0;
    std::memcpy(&word, open_.data() + e, std::min<std::size_t>(8, last - e));
    return word;
  };
  counts_.assign(chunks + 1, 0);
  for_chunks(pool, open_.size(), CellChunk::kCells, [&](std::size_t first, std::size_t last) {
    std::size_t count = 0;
    for (std::size_t e = first; e < last; e += 8) count += static_cast<std::size_t>(std::popcount(eight(e, last)));
    counts_[first / CellChunk::kCells + 1] = count;
  });
  std::partial_sum(counts_.begin(), counts_.end(), counts_.begin());
  result_.faces.resize(counts_.back());
  for_chunks(pool, open_.size(), CellChunk::kCells, [&](std::size_t first, std::size_t last) {
    ElementFace* to = result_.faces.data() + counts_[first / CellChunk::kCells];
    for (std::size_t e = first; e < last; e += 8) {
      if (eight(e, last) == 0) continue;
      for (std::size_t k = e; k < std::min(e + 8, last); ++k) {
        for (unsigned bits = open_[k]; bits != 0; bits &= bits - 1) {
          *to++ = {static_cast<Index>(k), static_cast<Index>(std::countr_zero(bits))};
        }
      }
    }
  });
}

void Clipping::gather_ghost(bool wanted) {
  result_.ghost.clear();
  if (!wanted) return;
  const auto visible = cells_.visible();
  std::ranges::copy_if(faces_.boundary(), std::back_inserter(result_.ghost), [&](ElementFace f) { return visible[f.element] == 0; });
}

void Clipping::cut(const ClippingView& view, const CellState& state, ThreadPool* pool) {
  const auto chunks = cells_.chunks();
  cut_parts_.resize(chunks.size());
  for_chunks(pool, chunks.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t c = first; c < last; ++c) {
      cut_parts_[c].clear();
      for (const Index e : chunks[c].crossed) cut_element(elements_, state.positions, e, view.clip, view.shrink, cut_parts_[c]);
    }
  });
  PlaneCuts& cuts = result_.cuts;
  cuts.clear();
  for (const PlaneCuts& part : cut_parts_) {
    const auto before = static_cast<Index>(cuts.points.size());
    for (CutPolygon polygon : part.polygons) {
      polygon.first += before;
      cuts.polygons.push_back(polygon);
    }
    cuts.points.insert(cuts.points.end(), part.points.begin(), part.points.end());
  }
}

const ClippedFaces& Clipping::update(const ClippingView& view, const CellState& state, ThreadPool* pool) {
  if (!fresh_ && view == view_ && state.serial == serial_) return result_;
  const bool had_cuts = !result_.cuts.polygons.empty();
  cells_.update(view, state, pool);
  const std::size_t changed = cells_.changed_count();
  const bool all_faces = view.shrink < 1.0, other_faces = fresh_ || all_faces != all_faces_;
  all_faces_ = all_faces;
  if (other_faces || changed * kFewChanges > open_.size()) {
    open_all(pool);
  } else if (changed > 0) {
    open_changed(pool);
  }
  if (other_faces || changed > 0) gather(pool);
  if (other_faces || changed > 0 || view.ghost != view_.ghost) {
    gather_ghost(view.ghost);
    ++result_.faces_revision;
  }
  cut(view, state, pool);
  if (had_cuts || !result_.cuts.polygons.empty()) ++result_.cuts_revision;
  result_.visible_cells = cells_.visible_count();
  view_ = view;
  serial_ = state.serial;
  fresh_ = false;
  return result_;
}

}  // namespace dmoscope
