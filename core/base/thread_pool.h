#pragma once
// Threads that are created once and reused.

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace dmoscope {

/// Runs loops over index ranges on a fixed number of threads (the caller's is one of them). Not reentrant; one loop at a time. Between
/// loops that follow each other closely its threads stay awake, for some 50 us; then they sleep.
class ThreadPool {
 public:
  /// Starts the threads. `threads` 0: one for each hardware thread.
  explicit ThreadPool(unsigned threads = 0);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;
  [[nodiscard]] unsigned size() const noexcept { return static_cast<unsigned>(workers_.size()) + 1; }

  /// Calls body(first, last) for chunks of at most `grain` indices that together cover [0, count), in any order and on any thread. Chunk
  /// boundaries are multiples of `grain` for any number of threads, so that sums by chunk are reproducible. The first exception of a body
  /// is thrown again here once all threads have stopped.
  void parallel_for(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body);

 private:
  struct Loop;
  void work(const std::stop_token& stop);
  bool wait_for_loop(std::unique_lock<std::mutex>& lock, const std::stop_token& stop, std::size_t seen);
  void finish(Loop& loop);
  static void drain(Loop& loop);

  bool patient_ = false;  // whether waiting awake takes no processor from working threads
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::condition_variable done_;
  Loop* loop_ = nullptr;                    // current loop; changed under the mutex, as are the following members
  std::atomic<std::size_t> generation_{0};  // number of loop_; read without the mutex by threads that wait awake
  std::atomic<std::size_t> busy_{0};        // number of workers in loop_; read without the mutex by threads that wait awake
  std::size_t asleep_ = 0;
  std::vector<std::jthread> workers_;
};

/// Calls parallel_for on `pool`, or runs the same chunks on the calling thread if it is null.
void for_chunks(ThreadPool* pool, std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body);

}  // namespace dmoscope
