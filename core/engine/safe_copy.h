#pragma once
// Files of autosaved sessions, and search for those that crashed windows left.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace dmoscope {

/// File lock of this process alone for the object's lifetime; the system releases it whenever the process ends.
class FileLock {
 public:
  /// Takes the lock; null if another process holds it, or the file cannot be locked. `create`: makes the file, which must be new.
  [[nodiscard]] static std::unique_ptr<FileLock> take(const std::filesystem::path& file, bool create);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

/// The three files of one window: its session, a description of it, and the lock that tells whether the window still lives.
struct SafeNames {
  std::filesystem::path session, about, lock;
};
/// Names "window-PID-N" with their extensions. `stem` may be any of the three.
[[nodiscard]] SafeNames safe_names(const std::filesystem::path& stem);
/// Whether a file in this folder is an autosaved one, and not the user's own.
[[nodiscard]] bool is_safe_name(const std::filesystem::path& file, const std::filesystem::path& folder);
/// Removes the files; missing ones are no failure.
void remove_safe(const SafeNames& names) noexcept;

/// A session that a window left behind.
struct Recoverable {
  SafeNames names;
  std::string mesh;             // path of its file, or the words that made it
  std::int64_t when = 0;        // seconds since 1970
  std::uint64_t iteration = 0;  // iteration of the active run
  std::size_t runs = 1;
  std::shared_ptr<const FileLock> lock;  // held, so that no other window offers it, too
};

/// Text of the description in SafeNames::about.
[[nodiscard]] std::string about_text(const Recoverable& what);

/// Sessions that dead windows left in a folder, newest first. Leftovers that are no sessions are removed.
[[nodiscard]] std::vector<Recoverable> find_recoverable(const std::filesystem::path& folder);

/// Place for the files of a window. make_safe_place() chooses names that no other window has, creates a missing folder, and holds the lock.
/// Throws OutputError.
struct SafePlace {
  SafeNames names;
  std::shared_ptr<const FileLock> lock;
};
[[nodiscard]] SafePlace make_safe_place(const std::filesystem::path& folder);

}  // namespace dmoscope
