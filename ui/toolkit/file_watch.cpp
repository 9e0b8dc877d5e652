#include "ui/toolkit/file_watch.h"

#include <chrono>
#include <utility>

namespace dmoscope::ui {
namespace {

/// Stamp of a file; none if it does not exist or cannot be read.
std::optional<FileStamp> stamp_of(const std::filesystem::path& file) {
  std::error_code error;
  FileStamp stamp;
  stamp.time = std::filesystem::last_write_time(file, error);
  if (error) return std::nullopt;
  stamp.size = std::filesystem::file_size(file, error);
  if (error) return std::nullopt;
  return stamp;
}

}  // namespace

void ChangeJudge::start(std::optional<FileStamp> known) {
  known_ = known;
  changed_.reset();
}

bool ChangeJudge::look(const std::optional<FileStamp>& stamp, double now) {
  if (!stamp || stamp == known_) {  // many programs remove a file for a moment when they save
    changed_.reset();
    return false;
  }
  if (stamp != changed_) {
    changed_ = stamp;
    since_ = now;
    return false;
  }
  if (now - since_ < kStable) return false;
  known_ = std::exchange(changed_, std::nullopt);
  return true;
}

FileWatch::FileWatch(std::function<void()> wake) : wake_(std::move(wake)), thread_([this](const std::stop_token& stop) { watch(stop); }) {}

void FileWatch::follow(const std::string& file) {
  {
    const std::scoped_lock lock(mutex_);
    if (file == file_) return;
    file_ = file;
    ++serial_;
    news_ = false;
  }
  changed_.notify_all();
}

bool FileWatch::take_change() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(news_, false);
}

void FileWatch::watch(const std::stop_token& stop) {
  constexpr std::chrono::milliseconds kPause{1000}, kPauseInChange{250};
  const auto begin = std::chrono::steady_clock::now();
  ChangeJudge judge;
  std::uint64_t serial = 0;
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    if (file_.empty()) {
      changed_.wait(lock, stop, [&] { return !file_.empty(); });
      continue;
    }
    const std::string file = file_;
    const bool other = serial != serial_;
    serial = serial_;
    lock.unlock();
    const std::optional<FileStamp> stamp = stamp_of(file);
    if (other) judge.start(stamp);
    const double now = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const bool written = judge.look(stamp, now);
    lock.lock();
    if (written && serial == serial_) {
      news_ = true;
      lock.unlock();
      if (wake_) wake_();
      lock.lock();
    }
    changed_.wait_for(lock, stop, judge.expecting() ? kPauseInChange : kPause, [&] { return serial != serial_; });
  }
}

}  // namespace dmoscope::ui
