#include "core/io/writing/litter.h"

#include <algorithm>

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace dmoscope {
namespace {

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

}  // namespace dmoscope
