#include "core/base/thread_pool.h"

#include <algorithm>
#include <atomic>
#include <exception>

namespace dmoscope {

struct ThreadPool::Loop {
  std::size_t count, grain;
  const std::function<void(std::size_t, std::size_t)>& body;
  std::atomic<std::size_t> next{0};
  std::mutex error_mutex;
  std::exception_ptr error;
};

ThreadPool::ThreadPool(unsigned threads) {
  if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
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
      loop.next = loop.count;  // nobody starts another chunk
    }
  }
}

void ThreadPool::work(const std::stop_token& stop) {
  std::size_t seen = 0;
  std::unique_lock lock(mutex_);
  while (wake_.wait(lock, stop, [&] { return generation_ != seen && loop_ != nullptr; })) {
    seen = generation_;
    Loop& loop = *loop_;
    ++busy_;
    lock.unlock();
    drain(loop);
    lock.lock();
    if (--busy_ == 0) done_.notify_all();
  }
}

void ThreadPool::parallel_for(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  grain = std::max<std::size_t>(grain, 1);
  if (workers_.empty() || count <= grain) {
    for_chunks(nullptr, count, grain, body);
    return;
  }
  Loop loop{count, grain, body, {}, {}, {}};
  {
    const std::scoped_lock lock(mutex_);
    loop_ = &loop;
    ++generation_;
  }
  wake_.notify_all();
  drain(loop);
  std::unique_lock lock(mutex_);
  loop_ = nullptr;  // a worker that wakes late finds nothing
  done_.wait(lock, [&] { return busy_ == 0; });
  if (loop.error) std::rethrow_exception(loop.error);
}

void for_chunks(ThreadPool* pool, std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  if (pool != nullptr) {
    pool->parallel_for(count, grain, body);
    return;
  }
  for (std::size_t first = 0; first < count; first += grain) body(first, std::min(first + grain, count));
}

}  // namespace dmoscope
