#include "core/base/thread_pool.h"

#include <algorithm>
#include <chrono>
#include <exception>

namespace dmoscope {

namespace {

/// Time of waiting awake: sleeping and being woken takes about as long.
constexpr auto kPatience = std::chrono::microseconds(50);

/// Tells the processor that this thread is only waiting.
void relax() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  __asm__ __volatile__("yield");
#endif
}

/// Waits awake until the condition holds, but not for longer than kPatience.
template <class Condition>
void linger(Condition holds) {
  constexpr int kLooks = 16;  // checks between two readings of the clock
  const auto end = std::chrono::steady_clock::now() + kPatience;
  do {
    for (int i = 0; i < kLooks; ++i) {
      if (holds()) return;
      relax();
    }
  } while (std::chrono::steady_clock::now() < end);
}

}  // namespace

struct ThreadPool::Loop {
  std::size_t count, grain;
  const std::function<void(std::size_t, std::size_t)>& body;
  std::atomic<std::size_t> next{0};
  std::mutex error_mutex;
  std::exception_ptr error;
};

ThreadPool::ThreadPool(unsigned threads) {
  const unsigned processors = std::max(1U, std::thread::hardware_concurrency());
  if (threads == 0) threads = processors;
  patient_ = threads <= processors;
  workers_.reserve(threads - 1);
  for (unsigned i = 1; i < threads; ++i) workers_.emplace_back([this](const std::stop_token& stop) { work(stop); });
}

ThreadPool::~ThreadPool() {
  for (std::jthread& worker : workers_) worker.request_stop();
  wake_.notify_all();
}

void ThreadPool::drain(Loop& loop) {
  for (;;) {
    const std::size_t first = loop.next.fetch_add(loop.grain, std::memory_order_relaxed);
    if (first >= loop.count) return;
    try {
      loop.body(first, std::min(first + loop.grain, loop.count));
    } catch (...) {
      const std::scoped_lock lock(loop.error_mutex);
      if (!loop.error) loop.error = std::current_exception();
      loop.next = loop.count;  // keeps threads from starting another chunk
    }
  }
}

/// Waits for a loop. Returns with the lock held: true if there is one later than `seen`, false if the pool ends.
bool ThreadPool::wait_for_loop(std::unique_lock<std::mutex>& lock, const std::stop_token& stop, std::size_t seen) {
  if (patient_) {
    lock.unlock();
    linger([&] { return generation_.load(std::memory_order_relaxed) != seen; });
    lock.lock();
  }
  ++asleep_;
  const bool found = wake_.wait(lock, stop, [&] { return generation_ != seen && loop_ != nullptr; });
  --asleep_;
  return found;
}

void ThreadPool::work(const std::stop_token& stop) {
  std::size_t seen = 0;
  std::unique_lock lock(mutex_);
  while (wait_for_loop(lock, stop, seen)) {
    seen = generation_;
    Loop& loop = *loop_;
    ++busy_;
    lock.unlock();
    drain(loop);
    lock.lock();
    if (--busy_ == 0) done_.notify_all();
  }
}

/// Waits until no thread works on `loop` any more, and removes it.
void ThreadPool::finish(Loop& loop) {
  {
    const std::scoped_lock lock(mutex_);
    loop_ = nullptr;  // a worker that wakes late finds no loop
  }
  const auto left = [&] { return busy_ == 0; };
  if (patient_) linger(left);
  if (!left()) {
    std::unique_lock lock(mutex_);
    done_.wait(lock, left);
  }
  if (loop.error) std::rethrow_exception(loop.error);
}

void ThreadPool::parallel_for(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  grain = std::max<std::size_t>(grain, 1);
  if (workers_.empty() || count <= grain) {
    for_chunks(nullptr, count, grain, body);
    return;
  }
  Loop loop{count, grain, body, {}, {}, {}};
  bool asleep = false;
  {
    const std::scoped_lock lock(mutex_);
    loop_ = &loop;
    ++generation_;
    asleep = asleep_ > 0;
  }
  if (asleep) wake_.notify_all();
  drain(loop);
  finish(loop);
}

void for_chunks(ThreadPool* pool, std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  if (pool != nullptr) {
    pool->parallel_for(count, grain, body);
    return;
  }
  for (std::size_t first = 0; first < count; first += grain) body(first, std::min(first + grain, count));
}

}  // namespace dmoscope
