#pragma once
// What a run keeps of its past: statistics of every iteration, and positions within a memory budget.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/quality/quality.h"

namespace dmoscope {

/// Where a run stands: whole iterations done, and visits done of the next one.
struct Moment {
  std::uint64_t iteration = 0;
  std::uint64_t visits = 0;
  friend auto operator<=>(const Moment&, const Moment&) = default;
};

struct IterationRecord {
  std::uint64_t iteration = 0;  // 0 is the input
  Statistics statistics;
  std::uint64_t moved = 0;
  double seconds = 0.0;  // this iteration's smoothing alone
};

class History {
 public:
  explicit History(std::size_t budget_bytes) : budget_(budget_bytes) {}

  /// Records iteration 0. Its positions are shared, never copied, whatever the budget.
  void record_input(const IterationRecord& record, std::shared_ptr<const std::vector<Vec3>> positions);
  /// Records the end of a later iteration; a record of the same iteration is kept as it was (a repeated iteration gives the same bits).
  /// Positions are kept when the iteration number is a multiple of stride() and there is room; when the budget is full the stride doubles
  /// and positions in between are let go: those iterations are computed again when asked for. `pool`: for the copy, may be null.
  void record(const IterationRecord& record, std::span<const Vec3> positions, ThreadPool* pool);
  [[nodiscard]] const std::vector<IterationRecord>& records() const noexcept { return records_; }

  struct Kept {
    std::uint64_t iteration;
    std::span<const Vec3> positions;
    std::shared_ptr<const void> owner;  // of the positions
  };
  /// The latest kept positions at or before `iteration`. The input (iteration 0) is always kept.
  [[nodiscard]] const Kept& nearest(std::uint64_t iteration) const;
  [[nodiscard]] bool kept(std::uint64_t iteration) const { return nearest(iteration).iteration == iteration; }

  void set_budget(std::size_t bytes);
  [[nodiscard]] std::size_t budget() const noexcept { return budget_; }
  /// Of the positions kept, without the input's.
  [[nodiscard]] std::size_t bytes() const noexcept;
  /// Every how many iterations positions are kept: 1 until the budget is first met.
  [[nodiscard]] std::uint64_t stride() const noexcept { return stride_; }
  /// Empty while every iteration is kept; else a sentence that says which are and that the others are computed again on demand.
  [[nodiscard]] std::string sentence() const;

 private:
  void thin(std::size_t needed);
  std::size_t budget_;
  std::uint64_t stride_ = 1;
  std::vector<IterationRecord> records_;
  std::vector<Kept> kept_;
};

}  // namespace dmoscope
