#include "core/io/writing/kept_attributes.h"

#include <cerrno>
#include <cstring>
#include <vector>

#include <sys/xattr.h>
#include <unistd.h>

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

}  // namespace

int keep_attributes(const std::filesystem::path& from, const struct stat& status, int descriptor) {
  keep_owner(status, descriptor);
  keep_extended(from, descriptor);
  return ::fchmod(descriptor, status.st_mode & 07777U) == 0 ? 0 : errno;
}

}  // namespace dmoscope
