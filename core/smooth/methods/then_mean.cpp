#include "core/smooth/methods/then_mean.h"

#include <utility>

#include "core/smooth/methods/dmo.h"

namespace dmoscope {

namespace {

class ThenMean final : public Smoother {
 public:
  ThenMean(std::unique_ptr<Smoother> first, SmoothingTask task) : first_(std::move(first)), task_(std::move(task)) {}

  void begin(const Sweep& sweep) override {
    if (!sweep.floor) {
      second_.reset();
      first_->begin(sweep);
    } else if (!second_ || floors_ != std::pair(sweep.floor, sweep.second_floor)) {
      second_ = make_dmo_smoother(task_, raise_mean_in(sweep, task_.metric, task_.combination, task_.guard));
      floors_ = {sweep.floor, sweep.second_floor};
    }
  }
  std::uint64_t visit(std::uint64_t first, std::uint64_t count, std::span<Vec3> positions, ThreadPool* pool) override {
    if (second_) {
      store(positions, pool);
      moved_on_ = true;
      return count_searched(*second_, first, count, positions, pool);
    }
    if (moved_on_) first_->positions_replaced();
    moved_on_ = false;
    unstored_ = true;
    return count_searched(*first_, first, count, positions, pool);
  }
  [[nodiscard]] std::optional<std::uint64_t> searched() const noexcept override { return searched_; }
  void store(std::span<Vec3> positions, ThreadPool* pool) override {
    if (unstored_) first_->store(positions, pool);
    unstored_ = false;
  }
  void positions_replaced() override {
    first_->positions_replaced();
    if (second_) second_->positions_replaced();
    unstored_ = moved_on_ = false;
  }
  void give(std::span<const Index> vertices, std::span<const Vec3> positions, std::span<Vec3> places) const override {
    (second_ ? *second_ : *first_).give(vertices, positions, places);
  }
  void take(std::span<const Index> vertices, std::span<const Vec3> places, std::span<Vec3> positions) override {
    (second_ ? *second_ : *first_).take(vertices, places, positions);
    unstored_ = unstored_ || !second_;
  }

 private:
  std::uint64_t count_searched(Smoother& who, std::uint64_t first, std::uint64_t count, std::span<Vec3> positions, ThreadPool* pool) {
    const auto before = who.searched();
    const std::uint64_t moved = who.visit(first, count, positions, pool);
    const auto after = who.searched();
    searched_ = searched_ && before && after ? std::optional(*searched_ + *after - *before) : std::nullopt;
    return moved;
  }

  std::unique_ptr<Smoother> first_, second_;  // the second where the mean is raised now
  SmoothingTask task_;
  std::pair<std::optional<double>, std::optional<double>> floors_{};  // floors of the second
  bool unstored_ = false;                                             // whether `first_` has visits that are not stored
  bool moved_on_ = false;                                             // whether positions differ from those that `first_` knows
  std::optional<std::uint64_t> searched_ = 0;
};

}  // namespace

std::unique_ptr<Smoother> then_mean(std::unique_ptr<Smoother> first, const SmoothingTask& task) {
  return std::make_unique<ThenMean>(std::move(first), task);
}

}  // namespace dmoscope
