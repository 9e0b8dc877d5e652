#include "core/io/source_file.h"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace dmoscope {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 22;  // bytes between two looks at the progress

/// An open file, closed when it goes.
class Descriptor {
 public:
  explicit Descriptor(const std::filesystem::path& path) : value_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const noexcept { return value_; }

 private:
  int value_;
};

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  throw InputError(path.string(), 0, std::generic_category().message(error));
}

}  // namespace

void SourceFile::add_only_in_file(std::string_view thing) {
  if (std::find(only_in_file_.begin(), only_in_file_.end(), thing) == only_in_file_.end()) only_in_file_.emplace_back(thing);
}

std::string read_whole_file(const std::filesystem::path& path, Progress& progress) {
  const Descriptor file(path);
  if (file.get() < 0) fail(path, errno);
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) fail(path, errno);
  if (S_ISDIR(status.st_mode)) fail(path, EISDIR);
  std::string bytes;
  std::size_t used = 0;
  // A regular file tells its size; a pipe does not, and a file may still grow: go on until nothing comes.
  bytes.resize(static_cast<std::size_t>(std::max<off_t>(status.st_size, 0)) + 1);
  for (;;) {
    progress.check();
    if (used == bytes.size()) bytes.resize(bytes.size() + std::max(bytes.size(), kChunk));
    const ssize_t got = ::read(file.get(), bytes.data() + used, std::min(kChunk, bytes.size() - used));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(path, errno);
    if (got == 0) break;
    used += static_cast<std::size_t>(got);
  }
  bytes.resize(used);
  return bytes;
}

}  // namespace dmoscope
