#pragma once
// Progress and cancellation of long work.

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>

#include "core/base/error.h"

namespace dmoscope {

/// Progress shared between the working thread and one that watches. All members may be used from any thread.
class Progress {
 public:
  /// Names the work ("reading east.14") and sets the fraction to 0.
  void begin(std::string label) {
    const std::scoped_lock lock(mutex_);
    label_ = std::move(label);
    fraction_ = 0.0;
  }
  /// Sets the fraction done, 0 to 1; that of the current part, if there is one.
  void set(double fraction) noexcept { fraction_ = base_ + span_ * fraction; }
  [[nodiscard]] double fraction() const noexcept { return fraction_; }
  [[nodiscard]] std::string label() const {
    const std::scoped_lock lock(mutex_);
    return label_;
  }
  void request_cancel() noexcept { cancel_ = true; }
  void clear_cancel() noexcept { cancel_ = false; }
  /// Throws Cancelled if a cancel was requested. To be called at least every 50 ms of work.
  void check() const {
    if (cancel_) throw Cancelled();
  }

  /// Restricts set(), for its lifetime, to one of `all` equal parts of the work, the one after the first `done`. Parts nest. To be made and
  /// destroyed by the working thread, while no other one reports.
  class Part {
   public:
    Part(Progress& progress, std::uint64_t done, std::uint64_t all) noexcept
        : progress_(progress), base_(progress.base_), span_(progress.span_) {
      progress.span_ = span_ / static_cast<double>(all);
      progress.base_ = base_ + static_cast<double>(done) * progress.span_;
    }
    ~Part() {
      progress_.base_ = base_;
      progress_.span_ = span_;
    }
    Part(const Part&) = delete;
    Part& operator=(const Part&) = delete;

   private:
    Progress& progress_;
    double base_, span_;
  };

 private:
  mutable std::mutex mutex_;
  std::string label_;
  std::atomic<double> fraction_{0.0};
  std::atomic<bool> cancel_{false};
  double base_ = 0.0, span_ = 1.0;  // range of the current part
};

}  // namespace dmoscope
