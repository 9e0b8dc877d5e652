#include "core/io/writing/text_writer.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <vector>

#include "core/base/thread_pool.h"

namespace dmoscope {
namespace {

/// Lets threads that work on chunks write in turn, and lends them buffers.
class Turns {
 public:
  std::unique_ptr<TextBuffer> borrow() {
    const std::scoped_lock lock(mutex_);
    if (free_.empty()) return std::make_unique<TextBuffer>();
    std::unique_ptr<TextBuffer> buffer = std::move(free_.back());
    free_.pop_back();
    buffer->clear();
    return buffer;
  }
  void give_back(std::unique_ptr<TextBuffer> buffer) {
    const std::scoped_lock lock(mutex_);
    free_.push_back(std::move(buffer));
  }
  /// Waits until all before `first` is written. False: it never will be.
  [[nodiscard]] bool wait_for(std::size_t first) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return failed_ || written_ == first; });
    return !failed_;
  }
  void wrote_until(std::size_t last) {
    const std::scoped_lock lock(mutex_);
    written_ = last;
    changed_.notify_all();
  }
  void fail() {
    const std::scoped_lock lock(mutex_);
    failed_ = true;
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t written_ = 0;
  bool failed_ = false;
  std::vector<std::unique_ptr<TextBuffer>> free_;
};

}  // namespace

void TextBuffer::grow(std::size_t least) {
  const std::size_t capacity = std::max({least, 2 * capacity_, std::size_t{4096}});
  auto larger = std::make_unique_for_overwrite<char[]>(capacity);
  std::memcpy(larger.get(), bytes_.get(), size_);
  bytes_ = std::move(larger);
  capacity_ = capacity;
}

void TextWriter::bytes(std::string_view bytes) {
  finish();
  while (!bytes.empty()) {  // writes in parts, so that a cancel is noticed in time
    context_.progress.check();
    file_->write(bytes.substr(0, kPiece));
    bytes.remove_prefix(std::min(kPiece, bytes.size()));
  }
}

void TextWriter::in_parts(std::size_t count, std::size_t grain, const std::function<void(TextBuffer&, std::size_t, std::size_t)>& format) {
  finish();
  Turns turns;
  // Chunks are taken in their order, so the one whose turn it is always is in work.
  for_chunks(context_.pool, count, grain, [&](std::size_t first, std::size_t last) {
    std::unique_ptr<TextBuffer> part = turns.borrow();
    std::exception_ptr error;
    try {
      format(*part, first, last);
    } catch (...) {
      error = std::current_exception();
    }
    if (!turns.wait_for(first)) return;
    try {
      if (error) std::rethrow_exception(error);
      context_.progress.check();
      file_->write(part->text());
    } catch (...) {
      turns.fail();
      throw;
    }
    turns.wrote_until(last);
    turns.give_back(std::move(part));
  });
}

void TextWriter::finish() {
  context_.progress.check();
  file_->write(buffer_.text());
  buffer_.clear();
}

}  // namespace dmoscope
