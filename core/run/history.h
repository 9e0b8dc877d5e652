#pragma once
// History of a run: statistics of every iteration, and positions within a memory budget.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/shared_vector.h"
#include "core/joint/joint_clusters.h"
#include "core/quality/quality.h"
#include "core/run/moment.h"
#include "core/run/percentiles.h"

namespace dmoscope {

/// Figures of an iteration of joint moves, which is one cluster.
struct JointFigures {
  JointState::End end = JointState::End::None;  // not None: there was nothing more to do, and all other figures are meaningless
  bool certified = false, is_push = false;      // see JointCluster
  double bound = 0.0, gap = 0.0;                // see JointCluster
  Index vertices = 0;                           // number of vertices of the cluster
  int newton_steps = 0;
  bool beyond = false;  // see JointCluster
};

struct IterationRecord {
  std::uint64_t iteration = 0;  // 0 is the input
  Statistics statistics;
  std::uint64_t moved = 0;
  double seconds = 0.0;        // this iteration's smoothing alone
  std::uint64_t searched = 0;  // vertices visited without those passed over, see Smoother::searched; 0 also where unknown
  std::optional<JointFigures> joint{};
  std::optional<double> second{};  // the movable minimum of a combination's second metric, where a phase may come that keeps it
  bool raises_mean = false;        // an iteration of the phase that raises a mean: see Sweep
  bool raise_follows = false;  // whether vertices around the worst element move together in the next iteration, within the method's phase
};

/// Returns whether positions on a device are worth a download only to keep them: it must take but a modest share of the time, `bringing`
/// seconds against `since` seconds of smoothing since positions were last kept.
[[nodiscard]] constexpr bool worth_downloading(double bringing, double since) noexcept {
  constexpr double kShare = 0.2;
  return bringing < kShare * since;
}

class History {
 public:
  explicit History(std::size_t budget_bytes) : budget_(budget_bytes) {}

  /// Records iteration 0. The input's positions are shared, never copied, whatever the budget.
  void record_input(const IterationRecord& record, std::shared_ptr<const std::vector<Vec3>> positions);
  /// Records the end of the next iteration. An iteration that has a record keeps it (a repeated iteration gives the same bits).
  void record(const IterationRecord& record);
  /// Gives the last recorded iteration the statistics of another: the run goes from its end to another state.
  void amend_last(const IterationRecord& other) {
    IterationRecord& last = records_.change().back();
    last.statistics = other.statistics;
    last.second = other.second;
  }
  /// Sets IterationRecord::raise_follows of the last record.
  void raise_after_last() { records_.change().back().raise_follows = true; }
  /// Returns whether keep() would keep the positions of this iteration: those of multiples of stride() are kept, where the budget has room
  /// for any.
  [[nodiscard]] bool wants(std::uint64_t iteration) const;
  /// Keeps positions, unless they are kept already or not wanted. When the budget is full the stride doubles and positions in between are
  /// let go: those iterations are computed again when asked for. `pool`: for the copy, may be null.
  void keep(std::uint64_t iteration, std::span<const Vec3> positions, ThreadPool* pool);
  /// Takes back records of the same path that were forgotten.
  void restore_records(const SharedVector<IterationRecord>& records);
  /// Keeps positions that were kept elsewhere, whether or not there is room for them.
  void hold(std::uint64_t iteration, std::span<const Vec3> positions, ThreadPool* pool);
  /// Forgets all that came after an iteration.
  void forget_after(std::uint64_t iteration);
  [[nodiscard]] const std::vector<IterationRecord>& records() const noexcept { return records_.values(); }
  [[nodiscard]] SharedVector<IterationRecord> shared_records() const { return records_.share(); }

  /// Percentiles of the records, as far as they have been worked out; may be shorter than the records.
  [[nodiscard]] const std::vector<Percentiles>& percentiles() const noexcept { return percentiles_.values(); }
  [[nodiscard]] SharedVector<Percentiles> shared_percentiles() const { return percentiles_.share(); }
  /// Stores the percentiles of a recorded iteration.
  void note_percentiles(std::uint64_t iteration, const Percentiles& percentiles);

  struct Kept {
    std::uint64_t iteration;
    std::span<const Vec3> positions;
    std::shared_ptr<const void> owner;  // owner of the positions
  };
  /// The latest kept positions at or before `iteration`. The input (iteration 0) is always kept.
  [[nodiscard]] const Kept& nearest(std::uint64_t iteration) const;
  [[nodiscard]] bool kept(std::uint64_t iteration) const { return nearest(iteration).iteration == iteration; }

  void set_budget(std::size_t bytes);
  [[nodiscard]] std::size_t budget() const noexcept { return budget_; }
  /// Memory of the positions kept, without the input's.
  [[nodiscard]] std::size_t bytes() const noexcept;
  /// Number of iterations from one with kept positions to the next: 1 until the budget is first met.
  [[nodiscard]] std::uint64_t stride() const noexcept { return stride_; }
  /// Sentence that says which iterations are kept, and that the others are computed again on demand; empty while every iteration is kept.
  [[nodiscard]] std::string sentence() const;

 private:
  void thin(std::size_t needed);
  std::size_t budget_;
  std::size_t size_ = 0;  // bytes of the positions of one iteration
  std::uint64_t stride_ = 1;
  GrowingVector<IterationRecord> records_;
  GrowingVector<Percentiles> percentiles_;
  std::vector<Kept> kept_;
};

}  // namespace dmoscope
