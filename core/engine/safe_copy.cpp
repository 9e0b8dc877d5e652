#include "core/engine/safe_copy.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/error.h"
#include "core/io/reading/source_file.h"

namespace dmoscope {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kSessionEnding = ".dmoscope", kAboutEnding = ".json", kLockEnding = ".lock", kStem = "window-";

std::int64_t written_at(const fs::path& file) {
  struct stat status {};
  return ::stat(file.c_str(), &status) == 0 ? static_cast<std::int64_t>(status.st_mtime) : 0;
}

/// Reads the description of a session; a text that makes no sense changes nothing.
void take_about(const fs::path& file, Recoverable& what) {
  constexpr std::size_t kMost = std::size_t{1} << 20U;
  nlohmann::json json;
  try {
    json = nlohmann::json::parse(read_small_text(file, kMost), nullptr, false);
  } catch (const InputError&) {
  }
  if (!json.is_object()) return;
  if (const auto at = json.find("mesh"); at != json.end() && at->is_string()) what.mesh = at->get<std::string>();
  if (const auto at = json.find("when"); at != json.end() && at->is_number_integer()) what.when = at->get<std::int64_t>();
  if (const auto at = json.find("iteration"); at != json.end() && at->is_number_unsigned()) what.iteration = at->get<std::uint64_t>();
  if (const auto at = json.find("runs"); at != json.end() && at->is_number_unsigned()) what.runs = at->get<std::size_t>();
}

}  // namespace

std::unique_ptr<FileLock> FileLock::take(const fs::path& file, bool create) {
  const int flags = create ? O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC : O_RDWR | O_CLOEXEC;
  const int descriptor = ::open(file.c_str(), flags, 0600);
  if (descriptor < 0) return nullptr;
  struct stat status {};
  const bool locked = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
  // Checks that the file still exists: another process may have removed it as a leftover just before it was locked.
  if (locked && ::fstat(descriptor, &status) == 0 && status.st_nlink > 0) return std::unique_ptr<FileLock>(new FileLock(descriptor));
  ::close(descriptor);
  return nullptr;
}

FileLock::~FileLock() { ::close(descriptor_); }

SafeNames safe_names(const fs::path& stem) {
  const auto ending = [&](std::string_view text) { return stem.parent_path() / (stem.stem().string() + std::string(text)); };
  return {ending(kSessionEnding), ending(kAboutEnding), ending(kLockEnding)};
}

bool is_safe_name(const fs::path& file, const fs::path& folder) {
  const std::string name = file.filename().string();
  return name.starts_with(kStem) && name.ends_with(kSessionEnding) && file.parent_path() == folder;
}

void remove_safe(const SafeNames& names) noexcept {
  // Removes the lock last: without it the other files would belong to nobody.
  for (const fs::path* file : {&names.session, &names.about, &names.lock}) ::unlink(file->c_str());
}

std::string about_text(const Recoverable& what) {
  const nlohmann::ordered_json json{{"mesh", what.mesh}, {"when", what.when}, {"iteration", what.iteration}, {"runs", what.runs}};
  return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::vector<Recoverable> find_recoverable(const fs::path& folder) {
  std::vector<Recoverable> found;
  std::error_code error;
  std::vector<fs::path> locks;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const fs::path name = at->path().filename();
    if (name.string().starts_with(kStem) && name.extension() == kLockEnding) locks.push_back(at->path());
  }
  for (const fs::path& file : locks) {
    std::shared_ptr<const FileLock> lock = FileLock::take(file, false);
    if (!lock) continue;  // skips the files of a living window
    Recoverable one{safe_names(file), {}, 0, 0, 1, std::move(lock)};
    std::error_code unknown;
    if (!fs::exists(one.names.session, unknown)) {
      remove_safe(one.names);
      continue;
    }
    one.when = written_at(one.names.session);
    take_about(one.names.about, one);
    found.push_back(std::move(one));
  }
  std::ranges::stable_sort(found, std::ranges::greater{}, &Recoverable::when);
  return found;
}

SafePlace make_safe_place(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder.string(), error.message());
  constexpr unsigned kTries = 100;
  int reason = 0;
  for (unsigned k = 0; k < kTries; ++k) {
    // Adds the time to the process number, since numbers are reused.
    const auto ticks = std::chrono::system_clock::now().time_since_epoch().count() + static_cast<std::int64_t>(k);
    SafeNames names = safe_names(folder / fmt::format("{}{}-{:x}.lock", kStem, ::getpid(), static_cast<std::uint64_t>(ticks)));
    errno = 0;
    if (std::shared_ptr<const FileLock> lock = FileLock::take(names.lock, true)) return {std::move(names), std::move(lock)};
    reason = errno;
    if (reason != EEXIST && reason != EWOULDBLOCK && reason != 0) break;
  }
  throw OutputError(folder.string(), reason == 0 ? "no file can be locked there" : std::generic_category().message(reason));
}

}  // namespace dmoscope
