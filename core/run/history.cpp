#include "core/run/history.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/base/memory.h"
#include "core/base/thread_pool.h"

namespace dmoscope {

namespace {

constexpr std::size_t kVerticesAtOnce = std::size_t{1} << 16U;

History::Kept copy_of(std::uint64_t iteration, std::span<const Vec3> positions, ThreadPool* pool) {
  const std::size_t count = positions.size();
  // Raw memory, because a vector would fill it on this thread before the others copy.
  const std::shared_ptr<Vec3> copy(std::allocator<Vec3>().allocate(count),
                                   [count](Vec3* p) { std::allocator<Vec3>().deallocate(p, count); });
  advise_large_pages(copy.get(), positions.size_bytes());
  for_chunks(pool, count, kVerticesAtOnce, [&](std::size_t first, std::size_t last) {
    std::uninitialized_copy(positions.begin() + static_cast<std::ptrdiff_t>(first), positions.begin() + static_cast<std::ptrdiff_t>(last),
                            copy.get() + first);
  });
  return {iteration, {copy.get(), count}, copy};
}

}  // namespace

void History::record_input(const IterationRecord& record, std::shared_ptr<const std::vector<Vec3>> positions) {
  records_.change().push_back(record);
  const std::span<const Vec3> view(*positions);
  size_ = view.size_bytes();
  kept_.push_back({record.iteration, view, std::move(positions)});
}

void History::record(const IterationRecord& record) {
  if (record.iteration == records().size()) records_.change().push_back(record);
}

// Keeps nothing without a budget, not even positions of a share without vertices: all processes keep alike.
bool History::wants(std::uint64_t iteration) const {
  return budget_ > 0 && iteration % stride_ == 0 && size_ <= budget_ && !kept(iteration);
}

void History::keep(std::uint64_t iteration, std::span<const Vec3> positions, ThreadPool* pool) {
  if (!wants(iteration)) return;
  thin(size_);
  if (!wants(iteration)) return;  // the stride may have grown
  kept_.insert(std::ranges::upper_bound(kept_, iteration, {}, &Kept::iteration), copy_of(iteration, positions, pool));
}

void History::restore_records(const SharedVector<IterationRecord>& all) {
  if (all.size() > records().size()) records_.replace(all.whole());
}

void History::note_percentiles(std::uint64_t iteration, const Percentiles& found) {
  auto& all = percentiles_.change();
  if (all.size() < records().size()) all.resize(records().size());
  all.at(iteration) = found;
}

void History::hold(std::uint64_t iteration, std::span<const Vec3> positions, ThreadPool* pool) {
  if (kept(iteration)) return;
  kept_.insert(std::ranges::upper_bound(kept_, iteration, {}, &Kept::iteration), copy_of(iteration, positions, pool));
}

void History::forget_after(std::uint64_t iteration) {
  if (records().size() > iteration + 1) records_.change().resize(iteration + 1);
  if (percentiles().size() > iteration + 1) percentiles_.change().resize(iteration + 1);
  std::erase_if(kept_, [&](const Kept& kept) { return kept.iteration > iteration; });
}

const History::Kept& History::nearest(std::uint64_t iteration) const {
  const auto after = std::ranges::upper_bound(kept_, iteration, {}, &Kept::iteration);
  return *std::prev(after);
}

void History::set_budget(std::size_t bytes) {
  budget_ = bytes;
  thin(0);
}

std::size_t History::bytes() const noexcept {
  std::size_t sum = 0;
  for (const Kept& kept : kept_) sum += kept.iteration == 0 ? 0 : kept.positions.size_bytes();
  return sum;
}

/// Lets positions go until there is room for `needed` more bytes, or only the input is left.
void History::thin(std::size_t needed) {
  while (bytes() + needed > budget_ && kept_.size() > 1) {
    stride_ *= 2;
    std::erase_if(kept_, [&](const Kept& kept) { return kept.iteration % stride_ != 0; });
  }
}

std::string History::sentence() const {
  if (kept_.size() == records().size()) return {};
  constexpr std::string_view kOthers = "the others are computed again when asked for";
  const bool full = stride_ > 1 || size_ > budget_;
  if (!full) return fmt::format("positions of {} of {} iterations are kept, {}", kept_.size() - 1, records().size() - 1, kOthers);
  const bool all_multiples = kept_.size() == (records().size() - 1) / stride_ + 1;
  const std::string kept = kept_.size() == 1
                               ? "only the input's positions are kept"
                               : fmt::format("positions are kept {} {} iterations", all_multiples ? "every" : "at most every", stride_);
  return fmt::format("history budget of {} MiB reached: {}, {}", budget_ >> 20U, kept, kOthers);
}

}  // namespace dmoscope
