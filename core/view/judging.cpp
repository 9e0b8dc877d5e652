#include "core/view/judging.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/memory.h"
#include "core/quality/tally.h"

namespace dmoscope {

namespace {

constexpr std::size_t kWorst = 100;

constexpr std::size_t kElementsJudgedAtOnce = std::size_t{1} << 15U;

/// A histogram under construction.
class Bins {
 public:
  void add(double q) { ++counts_[histogram_slot(q)]; }
  void add(const Bins& other) {
    for (std::size_t slot = 0; slot < counts_.size(); ++slot) counts_[slot] += other.counts_[slot];
  }
  [[nodiscard]] Histogram histogram() const {
    Histogram histogram;
    std::copy_n(counts_.begin(), Histogram::kBins, histogram.counts.begin());
    histogram.below = counts_[kSlotBelow];
    histogram.above = counts_[kSlotAbove];
    return histogram;
  }

 private:
  std::array<Index, kSlotNowhere + 1> counts_{};
};

bool worse(const RankedElement& a, const RankedElement& b) {
  return a.quality < b.quality || (a.quality == b.quality && a.element < b.element);
}

/// The worst of the elements offered so far.
class Worst {
 public:
  explicit Worst(std::size_t most) : most_(most) {}
  void offer(const RankedElement& ranked) {
    if (heap_.size() == most_) {
      if (most_ == 0 || !worse(ranked, heap_.front())) return;
      std::ranges::pop_heap(heap_, worse);
      heap_.back() = ranked;
    } else {
      if (std::isnan(ranked.quality)) return;
      heap_.push_back(ranked);
    }
    std::ranges::push_heap(heap_, worse);
  }
  void offer_all_of(const Worst& other) {
    for (const RankedElement& ranked : other.heap_) offer(ranked);
  }
  /// Returns the elements, worst first.
  [[nodiscard]] std::vector<RankedElement> take() {
    std::ranges::sort_heap(heap_, worse);
    return std::move(heap_);
  }

 private:
  std::size_t most_;
  std::vector<RankedElement> heap_;  // heap with the best of the worst on top
};

/// Results for a stretch of the elements.
struct Part {
  Tally tally;
  Bins bins;
  Worst worst{kWorst};
};

}  // namespace

void judge_elements(Frame& frame, std::span<const Index> immovable, ThreadPool* pool) {
  const std::size_t count = frame.input->mesh.elements.size();
  frame.quality = large_vector<float>(count);
  frame.inverted = large_vector<std::uint8_t>(count);
  std::vector<Part> parts((count + kElementsJudgedAtOnce - 1) / kElementsJudgedAtOnce);
  for_chunks(pool, count, kElementsJudgedAtOnce, [&](std::size_t first, std::size_t last) {
    Part part;
    for_blocks(frame.input->quality_context(), frame.positions, frame.shown, first, last, [&](const ElementBlock& block) {
      part.tally.add(block, immovable);
      for (std::size_t i = 0; i < block.count; ++i) {
        const double q = block.quality[i];
        frame.quality[block.first + i] = static_cast<float>(q);
        frame.inverted[block.first + i] = block.jacobian[i] <= 0.0 ? 1 : 0;
        part.bins.add(q);
        part.worst.offer({block.first + static_cast<Index>(i), q, block.jacobian[i] <= 0.0});
      }
    });
    parts[first / kElementsJudgedAtOnce] = std::move(part);
  });
  Part whole;
  for (const Part& part : parts) {
    whole.tally.append(part.tally);
    whole.bins.add(part.bins);
    whole.worst.offer_all_of(part.worst);
  }
  frame.shown_statistics = whole.tally.statistics();
  frame.now = whole.bins.histogram();
  frame.worst = whole.worst.take();
  for (RankedElement& ranked : frame.worst)
    if (ranked.inverted) ranked.inside = inverted_inside(frame.input->quality_context(), frame.positions, ranked.element);
}

InputSpread spread_of(const InputMesh& input, Metric metric, ThreadPool* pool) {
  struct Stretch {
    Bins bins;
    InputSpread spread;
  };
  const std::size_t count = input.mesh.elements.size();
  std::vector<Stretch> parts((count + kElementsJudgedAtOnce - 1) / kElementsJudgedAtOnce);
  for_chunks(pool, count, kElementsJudgedAtOnce, [&](std::size_t first, std::size_t last) {
    Stretch& part = parts[first / kElementsJudgedAtOnce];
    for_blocks(input.quality_context(), input.mesh.positions, metric, first, last, [&](const ElementBlock& block) {
      for (std::size_t i = 0; i < block.count; ++i) {
        const double q = block.quality[i];
        part.bins.add(q);
        if (block.jacobian[i] > 0.0 && !(q < 0.0)) part.spread.add(q);
      }
    });
  });
  Bins bins;
  InputSpread whole;
  for (const Stretch& part : parts) {
    bins.add(part.bins);
    whole.add(part.spread);
  }
  whole.histogram = bins.histogram();
  return whole;
}

Histogram make_histogram(std::span<const double> qualities) {
  Bins bins;
  for (const double q : qualities) bins.add(q);
  return bins.histogram();
}

std::vector<RankedElement> worst_elements(std::span<const double> qualities, std::size_t most) {
  Worst worst(most);
  for (std::size_t e = 0; e < qualities.size(); ++e) worst.offer({.element = static_cast<Index>(e), .quality = qualities[e]});
  return worst.take();
}

}  // namespace dmoscope
