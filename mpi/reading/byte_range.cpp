#include "mpi/reading/byte_range.h"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/error.h"

namespace dmoscope {

RangeFile::RangeFile(const std::filesystem::path& path) : path_(path) {
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat facts {};
  if (descriptor_ < 0 || ::fstat(descriptor_, &facts) != 0) {
    const int error = errno;
    if (descriptor_ >= 0) ::close(descriptor_);
    throw InputError(path.string(), 0, std::generic_category().message(error));
  }
  if (!S_ISREG(facts.st_mode)) {
    ::close(descriptor_);
    throw InputError(path.string(), 0, "this is no file whose parts can be read");
  }
  size_ = static_cast<std::uint64_t>(facts.st_size);
  stamp_ = static_cast<std::int64_t>(facts.st_mtim.tv_sec) * 1'000'000'000 + facts.st_mtim.tv_nsec + facts.st_size;
}

RangeFile::~RangeFile() { ::close(descriptor_); }

void RangeFile::read(std::uint64_t offset, std::span<char> bytes) const {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t got = ::pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw InputError(path_.string(), 0, std::generic_category().message(errno));
    if (got == 0) throw InputError(path_.string(), 0, "the file has become shorter while it was read");
    done += static_cast<std::size_t>(got);
  }
}

std::string RangeFile::read(std::uint64_t offset, std::uint64_t count) const {
  std::string bytes(std::min(count, size_ - std::min(offset, size_)), '\0');
  read(offset, bytes);
  return bytes;
}

void RangeFile::require_unchanged(std::int64_t stamp) const {
  if (stamp_ != stamp) throw InputError(path_.string(), 0, "the file has changed while it was smoothed");
}

namespace {

/// Whether a line ends here at which a text may be cut. `text[at]` is the line feed.
bool may_cut(const std::string& text, std::size_t at, bool joined) {
  if (!joined) return true;
  const std::size_t before = at > 0 && text[at - 1] == '\r' ? at - 1 : at;
  return before == 0 || text[before - 1] != '\\';
}

/// The start of the first line that starts at `offset` or later.
std::uint64_t next_line(const RangeFile& file, std::uint64_t offset, std::uint64_t begin, bool joined) {
  constexpr std::uint64_t kLook = 4096, kBack = 2;
  if (offset <= begin) return begin;
  std::string text;
  const std::uint64_t from = std::max(begin, offset - 1 - std::min<std::uint64_t>(offset - 1, kBack));
  for (std::uint64_t look = kLook;; look *= 4) {
    text = file.read(from, look);
    for (std::size_t at = text.find('\n', offset - 1 - from); at != std::string::npos; at = text.find('\n', at + 1))
      if (may_cut(text, at, joined)) return from + at + 1;
    if (from + text.size() >= file.size()) return file.size();
  }
}

}  // namespace

LineBlock read_lines(const World& world, const RangeFile& file, std::uint64_t begin, bool joined) {
  LineBlock block;
  world.together([&] {
    const Ranges bytes(file.size() - begin, world.size());
    const std::uint64_t first = next_line(file, begin + bytes.begin(world.rank()), begin, joined);
    const std::uint64_t last = next_line(file, begin + bytes.end(world.rank()), begin, joined);
    block.offset = first;
    block.text = file.read(first, last - first);
  });
  std::uint64_t before = 0;
  world.together([&] {  // the text before the first line that is dealt out
    if (!world.is_first()) return;
    const std::string head = file.read(0, begin);
    before = static_cast<std::uint64_t>(std::ranges::count(head, '\n'));
  });
  world.broadcast(before, 0);
  const Ranges lines = world.ranges(static_cast<std::uint64_t>(std::ranges::count(block.text, '\n')));
  block.first_line = 1 + before + lines.begin(world.rank());
  return block;
}

}  // namespace dmoscope
