#pragma once
// Threads that are made once and kept.

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace dmoscope {

/// Runs loops over index ranges on a fixed number of threads (the caller's is one of them). Not reentrant; one loop at a time.
/// Between loops that follow each other closely its threads stay awake, some 50 us long; then they sleep.
class ThreadPool {
 public:
  /// `threads` 0: one per hardware thread.
  explicit ThreadPool(unsigned threads = 0);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;
  [[nodiscard]] unsigned size() const noexcept { return static_cast<unsigned>(workers_.size()) + 1; }

  /// Calls body(first, last) for chunks of at most `grain` indices that together cover [0, count), in any order and on any
  /// thread. Chunk boundaries are multiples of `grain` whatever the number of threads, so that sums kept a chunk are reproducible.
  /// The first exception of a body is thrown again here once all threads have stopped.
  void parallel_for(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body);

 private:
  struct Loop;
  void work(const std::stop_token& stop);
  bool wait_for_loop(std::unique_lock<std::mutex>& lock, const std::stop_token& stop, std::size_t seen);
  void finish(Loop& loop);
  static void drain(Loop& loop);

  bool patient_ = false;  // whether waiting awake takes no processor from those that work
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::condition_variable done_;
  Loop* loop_ = nullptr;                    // changed under the mutex, as are the following
  std::atomic<std::size_t> generation_{0};  // of loop_; read without it by those that wait awake
  std::atomic<std::size_t> busy_{0};        // workers in loop_; likewise
  std::size_t asleep_ = 0;
  std::vector<std::jthread> workers_;
};

/// parallel_for on `pool`, or on the calling thread with the same chunks when it is null.
void for_chunks(ThreadPool* pool, std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body);

}  // namespace dmoscope
