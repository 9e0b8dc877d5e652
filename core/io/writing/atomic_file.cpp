#include "core/io/writing/atomic_file.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <vector>

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include "core/base/error.h"
#include "core/io/reading/gzip.h"

namespace dmoscope {

namespace {

/// Gives a file its former owner and group, or else the group alone: most users may not give a file away, but may choose one of their
/// groups.
void keep_owner(const struct stat& status, int descriptor) {
  struct stat now {};
  if (::fstat(descriptor, &now) != 0) return;
  if (now.st_uid == status.st_uid && now.st_gid == status.st_gid) return;
  if (::fchown(descriptor, status.st_uid, status.st_gid) == 0) return;
  if (::fchown(descriptor, static_cast<uid_t>(-1), status.st_gid) != 0) return;  // then the group stays that of the process, too
}

void keep_extended(const std::filesystem::path& from, int descriptor) {
  const ssize_t size = ::listxattr(from.c_str(), nullptr, 0);
  if (size <= 0) return;
  std::vector<char> names(static_cast<std::size_t>(size));
  const ssize_t listed = ::listxattr(from.c_str(), names.data(), names.size());
  for (ssize_t at = 0; at < listed; at += static_cast<ssize_t>(std::strlen(&names[static_cast<std::size_t>(at)])) + 1) {
    const char* const name = &names[static_cast<std::size_t>(at)];
    const ssize_t length = ::getxattr(from.c_str(), name, nullptr, 0);
    if (length < 0) continue;
    std::vector<char> value(static_cast<std::size_t>(length));
    const ssize_t got = ::getxattr(from.c_str(), name, value.data(), value.size());
    if (got >= 0) (void)::fsetxattr(descriptor, name, value.data(), static_cast<std::size_t>(got), 0);
  }
}

/// Gives an open file the permissions of another and, if the system allows it, its owner, its group and its extended attributes (with
/// access lists). Returns 0, or the system's error if the permissions cannot be given.
int keep_attributes(const std::filesystem::path& from, const struct stat& status, int descriptor) {
  keep_owner(status, descriptor);
  keep_extended(from, descriptor);
  return ::fchmod(descriptor, status.st_mode & 07777U) == 0 ? 0 : errno;
}

constexpr std::string_view kBegin = ".dmoscope-";
constexpr std::string_view kLitterEnd = ".tmp";

bool all_digits(std::string_view text) noexcept {
  return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

/// Removes a file whose process is dead, which released its lock. It is locked here meanwhile: a process that has just created it, and has
/// not locked it yet, waits and sees that it is gone. A name that by now is another file's is left alone.
void remove_if_dead(int folder, const char* name) noexcept {
  const int descriptor = ::openat(folder, name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return;
  struct stat opened {
  }, named{};
  if (::fstat(descriptor, &opened) == 0 && S_ISREG(opened.st_mode) && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 &&
      ::fstatat(folder, name, &named, AT_SYMLINK_NOFOLLOW) == 0 && named.st_ino == opened.st_ino && named.st_dev == opened.st_dev)
    (void)::unlinkat(folder, name, 0);
  ::close(descriptor);
}

}  // namespace

std::string litter_name(pid_t process, unsigned number) { return fmt::format("{}{}-{}{}", kBegin, process, number, kLitterEnd); }

bool is_litter_name(std::string_view name) noexcept {
  if (!name.starts_with(kBegin) || !name.ends_with(kLitterEnd) || name.size() < kBegin.size() + kLitterEnd.size()) return false;
  const std::string_view numbers = name.substr(kBegin.size(), name.size() - kBegin.size() - kLitterEnd.size());
  const std::size_t dash = numbers.find('-');
  return dash != std::string_view::npos && all_digits(numbers.substr(0, dash)) && all_digits(numbers.substr(dash + 1));
}

void remove_litter(const std::filesystem::path& folder) noexcept {
  DIR* const entries = ::opendir(folder.empty() ? "." : folder.c_str());
  if (entries == nullptr) return;
  while (const dirent* entry = ::readdir(entries))
    if (is_litter_name(entry->d_name)) remove_if_dead(::dirfd(entries), entry->d_name);
  ::closedir(entries);
}

namespace {

/// Whether an error means that the file system cannot tell when data are on disk; then there is nothing to wait for.
bool cannot_sync(int error) { return error == EINVAL || error == ENOTSUP || error == ENOSYS || error == EROFS; }

/// Writes the folder's entry for a new name to disk. Best effort: the file is complete by then, with its old or new contents.
void sync_folder(const std::filesystem::path& file) noexcept {
  const std::filesystem::path folder = file.parent_path();
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  (void)::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

std::filesystem::path follow_links(const std::filesystem::path& path) {
  constexpr int kMostLinks = 40;  // limit of the system
  std::filesystem::path target = path;
  std::error_code error;
  for (int i = 0; i < kMostLinks && std::filesystem::is_symlink(target, error); ++i) {
    const std::filesystem::path next = std::filesystem::read_symlink(target, error);
    if (error) break;
    target = next.is_absolute() ? next : target.parent_path() / next;
  }
  return target;
}

bool same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  namespace fs = std::filesystem;
  if (a.empty() || b.empty()) return false;
  std::error_code error;
  // Tries equivalent() first, which follows links but needs both files; absolute names also identify one that does not exist yet.
  if (fs::equivalent(a, b, error)) return true;
  const fs::path first = fs::weakly_canonical(fs::absolute(follow_links(a)), error);
  if (error) return false;
  const fs::path second = fs::weakly_canonical(fs::absolute(follow_links(b)), error);
  return !error && first == second;
}

AtomicFile::AtomicFile(const std::filesystem::path& path) : path_(path), target_(follow_links(path)) {
  struct stat status {};
  const bool exists = ::stat(target_.c_str(), &status) == 0;
  if (!exists && errno == ELOOP) fail(ELOOP);
  if (exists && S_ISDIR(status.st_mode)) fail(EISDIR);
  if (exists && ::access(target_.c_str(), W_OK) != 0) fail(errno);
  if (exists && !S_ISREG(status.st_mode)) {
    descriptor_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail(errno);
    return;
  }
  if (!target_.has_filename()) fail(path_.empty() ? ENOENT : EISDIR);
  remove_litter(target_.parent_path());
  open_temporary();
  if (!exists) return;
  if (status.st_nlink > 1) note_ = fmt::format("It had {} names (hard links): the others keep what it held before.", status.st_nlink);
  if (const int error = keep_attributes(target_, status, descriptor_); error != 0) {
    discard();
    fail(error);
  }
}

void AtomicFile::open_temporary() {
  static std::atomic<unsigned> counter{0};  // keeps threads apart; other processes differ by their id
  for (;;) {
    // Short for any name of the target, so that it is never too long for the file system.
    temporary_ = target_.parent_path() / litter_name(::getpid(), counter++);
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno == EEXIST) continue;
    if (descriptor_ < 0) {
      const int error = errno;
      temporary_.clear();
      fail(error);
    }
    // Checks that the file still exists: a cleaner takes an unlocked file for litter, as this one was for a moment. Waits for one that has
    // locked it by now, which then removes it.
    struct stat status {};
    while (::flock(descriptor_, LOCK_EX) != 0 && errno == EINTR) {
    }  // without locks nobody cleans up
    if (::fstat(descriptor_, &status) == 0 && status.st_nlink > 0) return;
    ::close(descriptor_);
  }
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::discard() noexcept {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
  temporary_.clear();
}

void AtomicFile::pack() {
  packer_ = std::make_unique<GzipPacker>([this](std::string_view packed) { write_plain(packed); });
}

void AtomicFile::reserve(std::uint64_t bytes) {
  if (const int error = bytes > 0 ? ::posix_fallocate(descriptor_, 0, static_cast<off_t>(bytes)) : 0; error != 0) fail(error);
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

void AtomicFile::finish() {
  if (packer_) packer_->finish();
  packer_.reset();
  if (!temporary_.empty() && ::fsync(descriptor_) != 0 && !cannot_sync(errno)) fail(errno);
}

void AtomicFile::commit() {
  finish();
  // Renames before closing, which would unlock the file.
  if (!temporary_.empty()) {
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
    temporary_.clear();
    sync_folder(target_);
  }
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  if (closed != 0 && errno != EINTR) fail(errno);
}

void AtomicFile::fail(int error) const { throw OutputError(path_.string(), std::generic_category().message(error)); }

void AtomicFiles::add(const std::filesystem::path& path, std::string_view bytes) {
  auto file = std::make_unique<AtomicFile>(path);
  file->write(bytes);
  file->finish();
  files_.push_back(std::move(file));
}

void AtomicFiles::commit() {
  for (const auto& file : files_) file->commit();
  files_.clear();
}

void write_file_atomically(const std::filesystem::path& path, std::string_view bytes) {
  AtomicFiles file;
  file.add(path, bytes);
  file.commit();
}

}  // namespace dmoscope
