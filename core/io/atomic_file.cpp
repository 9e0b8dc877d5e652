#include "core/io/atomic_file.h"

#include <atomic>
#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/error.h"
#include "core/io/gzip.h"
#include "core/io/mesh_io.h"

namespace dmoscope {

std::filesystem::path follow_links(const std::filesystem::path& path) {
  constexpr int kMostLinks = 40;  // as the system's own limit
  std::filesystem::path target = path;
  std::error_code error;
  for (int i = 0; i < kMostLinks && std::filesystem::is_symlink(target, error); ++i) {
    const std::filesystem::path next = std::filesystem::read_symlink(target, error);
    if (error) break;
    target = next.is_absolute() ? next : target.parent_path() / next;
  }
  return target;
}

AtomicFile::AtomicFile(const std::filesystem::path& path) : path_(path), target_(follow_links(path)) {
  struct stat status {};
  const bool exists = ::stat(target_.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) fail(EISDIR);
  if (exists && ::access(target_.c_str(), W_OK) != 0) fail(errno);
  if (exists && !S_ISREG(status.st_mode)) {
    descriptor_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail(errno);
    return;
  }
  if (!target_.has_filename()) fail(path_.empty() ? ENOENT : EISDIR);
  open_temporary();
  if (exists && ::fchmod(descriptor_, status.st_mode & 07777U) != 0) {
    const int error = errno;
    discard();
    fail(error);
  }
}

void AtomicFile::open_temporary() {
  static std::atomic<unsigned> counter{0};  // so that two threads never meet; other processes differ by their id
  do {
    // Short, whatever the target's name, so that it never is too long for the file system.
    const std::string name = ".dmoscope-" + std::to_string(::getpid()) + "-" + std::to_string(counter++) + ".tmp";
    temporary_ = target_.parent_path() / name;
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ < 0) {
    const int error = errno;
    temporary_.clear();
    fail(error);
  }
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::discard() noexcept {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  temporary_.clear();
}

void AtomicFile::pack() {
  packer_ = std::make_unique<GzipPacker>([this](std::string_view packed) { write_plain(packed); });
}

void AtomicFile::write(std::string_view bytes) {
  if (packer_) {
    packer_->add(bytes);
  } else {
    write_plain(bytes);
  }
}

void AtomicFile::write_plain(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void AtomicFile::commit() {
  if (packer_) packer_->finish();
  const int closed = ::close(descriptor_);  // some file systems tell only now that the disk is full
  descriptor_ = -1;
  if (closed != 0 && errno != EINTR) fail(errno);
  if (temporary_.empty()) return;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.clear();
}

void AtomicFile::fail(int error) const { throw OutputError(path_.string(), std::generic_category().message(error)); }

void write_file_atomically(const std::filesystem::path& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace dmoscope
