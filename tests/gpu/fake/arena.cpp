#include "tests/gpu/fake/arena.h"

#include <cstring>
#include <new>

#include <sys/mman.h>

namespace dmoscope::gpu::fake {

namespace {
constexpr std::size_t kBytes = std::size_t{1} << 33U, kAlignment = 256, kPage = 4096;  // addresses alone cost nothing
constexpr std::size_t up(std::size_t bytes, std::size_t unit) { return (bytes + unit - 1) / unit * unit; }
}  // namespace

Arena::Arena() {
  void* const memory = mmap(nullptr, kBytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  begin_ = static_cast<std::byte*>(memory);
}
Arena::~Arena() { munmap(begin_, kBytes); }

void* Arena::take(std::size_t bytes) {
  if (bytes > kBytes - kAlignment - used_) return nullptr;
  const std::size_t end = up(used_ + bytes, kAlignment);
  std::byte* const memory = begin_ + used_;
  used_ = end;
  if (opened_ > 0) mprotect(begin_, up(used_, kPage), PROT_READ | PROT_WRITE);
  std::memset(memory, 0xcd, bytes);
  return memory;
}
void Arena::clear() {
  madvise(begin_, up(used_, kPage), MADV_DONTNEED);
  used_ = 0;
}
void Arena::open() {
  if (opened_++ == 0 && used_ > 0) mprotect(begin_, up(used_, kPage), PROT_READ | PROT_WRITE);
}
void Arena::close() {
  if (--opened_ == 0 && used_ > 0) mprotect(begin_, up(used_, kPage), PROT_NONE);
}

}  // namespace dmoscope::gpu::fake
