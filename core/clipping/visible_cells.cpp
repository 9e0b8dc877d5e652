#include "core/clipping/visible_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "core/base/error.h"
#include "core/base/memory.h"

namespace dmoscope {

namespace {

void require_sense(const ClippingView& view, const CellState& state, const ElementTable& elements) {
  const ClipPlane& clip = view.clip;
  if (clip.on) {
    const double size = length(clip.normal);
    if (!std::isfinite(size) || !(size > 0.0)) throw UsageError("a clip plane needs a normal that has a direction");
    if (!std::isfinite(clip.offset)) throw UsageError("a clip plane needs an offset that is a number");
  }
  if (!(view.shrink > 0.0 && view.shrink <= 1.0)) throw UsageError("cells shrink to a factor greater than 0 and at most 1");
  if (view.peel_quality && std::isnan(*view.peel_quality)) throw UsageError("cells are peeled by a quality that is a number");
  if (view.isolate && !(view.isolate->first <= view.isolate->second)) {
    throw UsageError("cells are isolated by a range of qualities, the lower one first");
  }
  if (view.by_quality() && state.quality.size() != elements.size()) throw UsageError("as many qualities as the mesh has cells are needed");
  if (!state.inverted.empty() && state.inverted.size() != elements.size()) {
    throw UsageError("as many cells must be told inverted or not as there are");
  }
}

/// Settings of a view that decide on single cells by their quality.
class QualityRule {
 public:
  QualityRule(const ClippingView& view, const CellState& state) : view_(view), state_(state) {}
  [[nodiscard]] bool keeps(std::size_t cell) const {
    const bool inverted = !state_.inverted.empty() && state_.inverted[cell] != 0;
    const float quality = state_.quality[cell];
    if (view_.peel_quality && !inverted && quality > *view_.peel_quality) return false;
    if (!view_.isolate) return true;
    if (inverted) return view_.isolate->first <= 0.0F;
    return quality >= view_.isolate->first && quality <= view_.isolate->second;
  }

 private:
  const ClippingView& view_;
  const CellState& state_;
};

}  // namespace

std::vector<Index> layers_of(const ElementTable& elements, const FaceNeighbours& faces) {
  auto layers = large_vector<Index>(elements.size(), kNoIndex);
  std::vector<Index> queue;
  queue.reserve(elements.size());
  for (const ElementFace& face : faces.boundary()) {
    if (layers[face.element] == 0) continue;
    layers[face.element] = 0;
    queue.push_back(face.element);
  }
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (const Index other : faces.of(queue[i])) {
      if (other == kNoIndex || layers[other] != kNoIndex) continue;
      layers[other] = layers[queue[i]] + 1;
      queue.push_back(other);
    }
  }
  return layers;
}

VisibleCells::VisibleCells(const ElementTable& elements, const FaceNeighbours& faces)
    : elements_(elements),
      faces_(faces),
      visible_(large_vector<std::uint8_t>(elements.size())),
      chunks_((elements.size() + CellChunk::kCells - 1) / CellChunk::kCells) {}

std::size_t VisibleCells::changed_count() const noexcept {
  return std::accumulate(chunks_.begin(), chunks_.end(), std::size_t{0}, [](auto sum, const auto& c) { return sum + c.changed.size(); });
}

std::size_t VisibleCells::visible_count() const noexcept {
  return std::accumulate(chunks_.begin(), chunks_.end(), std::size_t{0}, [](auto sum, const auto& c) { return sum + c.visible; });
}

/// Computes the heights of all vertices, and the lowest and highest of every cell.
void VisibleCells::measure(Vec3 normal, const CellState& state, ThreadPool* pool) {
  if (measured_normal_ == normal && measured_serial_ == state.serial) return;
  if (heights_.size() != state.positions.size()) heights_ = large_vector<double>(state.positions.size());
  if (low_.size() != elements_.size()) {
    low_ = large_vector<double>(elements_.size());
    high_ = large_vector<double>(elements_.size());
  }
  for_chunks(pool, heights_.size(), CellChunk::kCells, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) heights_[v] = dot(normal, state.positions[v]);
  });
  for_chunks(pool, elements_.size(), CellChunk::kCells, [&](std::size_t first, std::size_t last) {
    for (std::size_t e = first; e < last; ++e) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const Index v : elements_.corners(static_cast<Index>(e))) {
        low = std::min(low, heights_[v]);
        high = std::max(high, heights_[v]);
      }
      low_[e] = low;
      high_[e] = high;
    }
  });
  measured_normal_ = normal;
  measured_serial_ = state.serial;
}

/// Ranks the worst cells: inverted ones first, whatever their metric, undefined ones never; then by quality, and equal ones by number.
void VisibleCells::rank_worst(std::size_t count, const CellState& state) {
  if (ranked_count_ == count && ranked_serial_ == state.serial) return;
  const auto key = [&](Index e) {
    const bool inverted = !state.inverted.empty() && state.inverted[e] != 0;
    const float quality = state.quality[e];
    return std::tuple(!inverted, inverted && std::isnan(quality) ? -std::numeric_limits<float>::infinity() : quality, e);
  };
  std::vector<Index> order;
  order.reserve(elements_.size());
  for (Index e = 0; e < elements_.size(); ++e) {
    if (!std::isnan(std::get<float>(key(e)))) order.push_back(e);
  }
  among_worst_.assign(elements_.size(), 0);
  const auto end = order.begin() + static_cast<std::ptrdiff_t>(std::min(count, order.size()));
  if (end != order.end()) std::nth_element(order.begin(), end, order.end(), [&](Index a, Index b) { return key(a) < key(b); });
  for (auto it = order.begin(); it != end; ++it) among_worst_[*it] = 1;
  ranked_count_ = count;
  ranked_serial_ = state.serial;
}

void VisibleCells::update(const ClippingView& view, const CellState& state, ThreadPool* pool) {
  require_sense(view, state, elements_);
  if (view.clip.on) measure(view.clip.normal, state, pool);
  if (view.worst > 0) rank_worst(view.worst, state);
  if (view.peel > 0 && layers_.empty()) layers_ = layers_of(elements_, faces_);
  const QualityRule rule(view, state);
  const bool by_range = view.peel_quality || view.isolate, cut = view.clip.on && view.clip.mode == ClipPlane::Mode::Cut;
  const double offset = view.clip.offset;
  const auto seen = [&](std::size_t e) {
    if (view.clip.on && !(view.clip.flip ? high_[e] > offset : low_[e] < offset)) return false;
    if (view.peel > 0 && layers_[e] < view.peel) return false;
    if (view.worst > 0 && among_worst_[e] == 0) return false;
    return !by_range || rule.keeps(e);
  };
  for_chunks(pool, elements_.size(), CellChunk::kCells, [&](std::size_t first, std::size_t last) {
    CellChunk& chunk = chunks_[first / CellChunk::kCells];
    chunk.changed.clear();
    chunk.crossed.clear();
    chunk.visible = 0;
    for (std::size_t e = first; e < last; ++e) {
      const std::uint8_t now = seen(e) ? 1 : 0;
      chunk.visible += now;
      if (cut && now != 0 && low_[e] < offset && high_[e] > offset) chunk.crossed.push_back(static_cast<Index>(e));
      if (visible_[e] == now) continue;
      visible_[e] = now;
      chunk.changed.push_back(static_cast<Index>(e));
    }
  });
}

}  // namespace dmoscope
